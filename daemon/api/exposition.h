// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes the text format of Prometheus, version 0.0.4. prometheus-cpp would do so too, but has
// counters of its own: here a thing is counted where it happens, and to hand all counts to the
// library for each answer takes more lines than to write them. A value; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scipd::daemon {

class Exposition {
  public:
    enum class Type { counter, gauge, histogram };
    /// Names and their values, which may hold any text.
    using Labels = std::vector<std::pair<std::string_view, std::string_view>>;

    /// Begins a metric: all samples up to the next one are of it. `help` is one line.
    void metric(std::string_view name, Type type, std::string_view help);

    void sample(const Labels& labels, std::uint64_t value) { sample("", labels, value); }
    void sample(const Labels& labels, double value) { sample("", labels, value); }
    /// Of a histogram: `suffix` is _bucket, _sum or _count.
    void sample(std::string_view suffix, const Labels& labels, std::uint64_t value);
    void sample(std::string_view suffix, const Labels& labels, double value);

    [[nodiscard]] std::string finish() { return std::move(text_); }

    /// As short as it can be without becoming another number.
    [[nodiscard]] static std::string number(double value);

  private:
    void line(std::string_view suffix, const Labels& labels, std::string_view value);

    std::string name_;
    std::string text_;
};

}  // namespace scipd::daemon
