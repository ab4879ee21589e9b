// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The words of a line, between blanks, taken from its front. A value; no thread rule.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/text/text_number.h"

namespace scipd::sim {

class WordLine {
  public:
    explicit WordLine(std::string_view line) {
        for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
            const std::string_view word = line.substr(0, line.find_first_of(" \t"));
            words_.push_back(word);
            line.remove_prefix(word.size());
        }
    }

    /// Empty at the end of the line.
    std::string_view word() { return next_ < words_.size() ? words_[next_++] : std::string_view{}; }

    /// Keeps in mind where there was none.
    double number() {
        std::string_view text = word();
        if (text.starts_with('+')) text.remove_prefix(1);
        const auto value = parse_number(text);
        if (!value) wrong_ = true;
        return value.value_or(0);
    }
    /// How many numbers follow: no more than there are words.
    std::size_t count() {
        const double value = number();
        const auto left = static_cast<double>(words_.size() - next_);
        if (!(value >= 0 && value <= left)) wrong_ = true;
        return wrong_ ? 0 : static_cast<std::size_t>(value);
    }
    std::vector<double> numbers(std::size_t count) {
        std::vector<double> values(count);
        for (double& value : values)
            value = number();
        return values;
    }

    void skip(std::size_t count) { next_ += count; }
    [[nodiscard]] std::size_t left() const {
        return next_ < words_.size() ? words_.size() - next_ : 0;
    }
    /// A word from the end of the line, 0 for the last; empty if there is none.
    [[nodiscard]] std::string_view from_end(std::size_t index) const {
        return index < words_.size() ? words_[words_.size() - 1 - index] : std::string_view{};
    }
    /// Whether a number was asked for where there was none.
    [[nodiscard]] bool wrong() const { return wrong_; }

  private:
    std::vector<std::string_view> words_;
    std::size_t next_ = 0;
    bool wrong_ = false;
};

}  // namespace scipd::sim
