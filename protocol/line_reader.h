// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cuts a stream of bytes into request lines, whatever pieces the bytes come in. LF and CR both end
// a line, so CR LF ends one and leaves an empty one behind; empty lines are passed over in silence,
// as a real scanner does (urg_library begins every session with a lone LF and expects nothing).
// So is NUL where a line would begin: deduced, openFrameworks' TCP client sends one behind each
// line, and programs made with it were written for real scanners.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scipd::protocol {

struct Line {
    std::string text;       ///< without its terminator, never empty
    bool overlong = false;  ///< more came than max_length; the text is its beginning
};

class LineReader {
  public:
    /// The longest real request has 15 characters and a string of 17; what a scanner does with more
    /// is undocumented.
    static constexpr std::size_t max_length = 128;

    /// Takes bytes off the front of `bytes` until a line is complete; nothing: all were taken and
    /// more are needed.
    std::optional<Line> next(std::string_view& bytes);

  private:
    Line line_;  ///< of what has come so far
};

}  // namespace scipd::protocol
