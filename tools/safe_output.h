// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Filters what goes to a terminal. Names and messages come from configurations, worlds and
// scanners, and anybody may have written them. One thread.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace scipd::tools {

/// As long as this object lives, the stream writes its text as sim::shown() shows it.
class SafeOutput : public std::streambuf {
  public:
    explicit SafeOutput(std::ostream& stream);
    ~SafeOutput() override;
    SafeOutput(const SafeOutput&) = delete;
    SafeOutput& operator=(const SafeOutput&) = delete;

    /// Writes text as it is, for programs that colour it. What others wrote of it must have been
    /// through sim::shown().
    static void write_as_is(std::ostream& stream, std::string_view text);

  protected:
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;

  private:
    bool pass_on(std::size_t size);

    std::ostream& stream_;
    std::streambuf* out_;
    std::string line_;  ///< the line that has not ended yet
};

}  // namespace scipd::tools
