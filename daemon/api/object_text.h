// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A JSON object written as text, member after member, for lists as long as a picture has pixels: as
// a tree of values they would hold the I/O thread six times as long. A value; no thread rule.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/api/documents.h"

namespace scipd::daemon {

class ObjectText {
  public:
    /// Begins with the members of an object.
    explicit ObjectText(const Json& members);

    void add(std::string_view name, const Json& value);

    /// `append(text, element)` appends the JSON of one.
    template <class List, class Append>
    void add_list(std::string_view name, const List& list, Append append) {
        begin(name);
        constexpr std::size_t likely = 10;  // characters of an element
        text_.reserve(text_.size() + likely * list.size());
        char before = '[';
        for (const auto& element : list) {
            text_ += std::exchange(before, ',');
            append(text_, element);
        }
        text_ += list.empty() ? "[]" : "]";
    }

    [[nodiscard]] std::string finish() &&;

  private:
    void begin(std::string_view name);

    std::string text_;  ///< without its last brace
};

/// All its digits; it is finite.
void append_number(std::string& text, double value);

/// {"time_s","xyz","q"}, as pose_document() has it.
void append_timed_pose(std::string& text, double time_s, const sim::Pose& pose);

/// As rounded() has it; null where it is not finite.
void append_rounded(std::string& text, double value);

}  // namespace scipd::daemon
