// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a person or a signal ends a program that runs on and on. One thread.
#pragma once

#include <chrono>
#include <memory>

namespace scipd::tools {

/// As long as it lives, keys that are pressed are not shown, SIGINT (Ctrl-C), SIGTERM and SIGHUP do
/// not end the program, and afterwards the terminal is as it was.
class Keyboard {
  public:
    Keyboard();
    Keyboard(const Keyboard&) = delete;
    Keyboard& operator=(const Keyboard&) = delete;
    ~Keyboard();

    /// Waits so long. True, and at once: q was pressed, or one of the signals came. Where standard
    /// input is no terminal nobody presses anything.
    [[nodiscard]] bool ends_within(std::chrono::milliseconds time);

  private:
    struct Settings;
    std::unique_ptr<Settings> before_;  ///< of the terminal; null: there is none
};

/// Whether standard output is a terminal.
[[nodiscard]] bool draws_on_terminal();

}  // namespace scipd::tools
