// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cuts a stream of bytes into request lines, whatever pieces the bytes come in. LF and CR each end
// a line. The reader passes over empty lines in silence, such as the one between CR and LF. A real
// scanner does so too: urg_library begins every session with a lone LF and expects nothing. The
// reader also passes over a NUL where a line would begin. This is deduced: openFrameworks' TCP
// client sends a NUL behind each line, and programs made with it were written for real scanners.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scipd::protocol {

struct Line {
    std::string text;       ///< without its terminator, never empty
    bool overlong = false;  ///< the line is too long; the text is its beginning
};

class LineReader {
  public:
    /// The longest real request has 15 characters and a string of 17. What a scanner does with more
    /// is undocumented.
    static constexpr std::size_t max_length = 128;

    explicit LineReader(std::size_t longest = max_length) : longest_(longest) {}

    /// Takes bytes off the front of `bytes` until a line is complete. Nothing: all bytes were taken
    /// and more are needed.
    std::optional<Line> next(std::string_view& bytes);

    /// Forgets what has come of a line.
    void forget() { line_ = {}; }

  private:
    std::size_t longest_;
    Line line_;  ///< of what has come so far
};

}  // namespace scipd::protocol
