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
#include <vector>

#include "daemon/api/documents.h"

namespace scipd::daemon {

class ObjectText {
  public:
    /// Begins with the members of an object.
    explicit ObjectText(const Json& members);

    void add(std::string_view name, const Json& value);

    /// `append(text, i)` appends the JSON of element i.
    template <class Append>
    void add_list(std::string_view name, std::size_t size, Append append) {
        begin(name);
        constexpr std::size_t likely = 10;  // characters of an element
        text_.reserve(text_.size() + likely * size);
        char before = '[';
        for (std::size_t i = 0; i < size; ++i) {
            text_ += std::exchange(before, ',');
            append(text_, i);
        }
        text_ += size == 0 ? "[]" : "]";
    }
    /// `append(text, element)` appends the JSON of one.
    template <class Element, class Append>
    void add_list(std::string_view name, const std::vector<Element>& list, Append append) {
        add_list(name, list.size(),
                 [&](std::string& text, std::size_t i) { append(text, list[i]); });
    }

    [[nodiscard]] std::string finish() &&;

  private:
    void begin(std::string_view name);

    std::string text_;  ///< without its last brace
};

/// All its digits; it is finite.
void append_number(std::string& text, double value);

/// {"xyz","q"}, as pose_document() has it.
void append_pose(std::string& text, const sim::Pose& pose);

/// {"time_s","xyz","q"}
void append_timed_pose(std::string& text, double time_s, const sim::Pose& pose);

/// As rounded() has it; null where it is not finite.
void append_rounded(std::string& text, double value);

}  // namespace scipd::daemon
