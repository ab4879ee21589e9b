// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Catches what libsdformat 12 and urdfdom print. They return some faults and only print others, and
// they only print warnings. The whole process shares the consoles that they print on, so every
// caller of these libraries must hold an SdfConsole; other threads wait for it.
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
    /// What the libraries printed since the last take() or the constructor, each text once.
    Said take();

  private:
    void log(const std::string& text, console_bridge::LogLevel level, const char* file,
             int line) override;

    std::lock_guard<std::mutex> turn_;
    std::stringstream text_;
    std::stringstream on_stderr_;  ///< dropped: also returned, or without a place
    std::streambuf* stderr_before_;
    Said from_urdfdom_;
};

}  // namespace scipd::sim
