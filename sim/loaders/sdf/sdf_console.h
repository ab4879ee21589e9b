// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What libsdformat 12 and urdfdom print: they return some faults and print others, and warnings are
// only printed, all on consoles that the whole process shares. Whoever calls them holds one of
// these; other threads wait for their turn.
#pragma once

#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include <console_bridge/console.h>

namespace scipd::sim {

class SdfConsole final : console_bridge::OutputHandler {
  public:
    SdfConsole();
    ~SdfConsole() override;
    SdfConsole(const SdfConsole&) = delete;
    SdfConsole& operator=(const SdfConsole&) = delete;

    struct Said {
        std::vector<std::string> faults;
        std::vector<std::string> warnings;
    };
    /// Since it was made or asked last; each once.
    Said take();

  private:
    void log(const std::string& text, console_bridge::LogLevel level, const char* file,
             int line) override;

    std::lock_guard<std::mutex> turn_;
    std::stringstream text_;
    std::stringstream on_stderr_;  ///< what it returns as well, or knows no place of
    std::streambuf* stderr_before_;
    Said from_urdfdom_;
};

}  // namespace scipd::sim
