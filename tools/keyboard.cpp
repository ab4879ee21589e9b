// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/keyboard.h"

#include <algorithm>
#include <csignal>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace scipd::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t signalled = 0;

void note(int /*signal*/) {
    signalled = 1;
}

bool in_foreground() {
    return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
}

}  // namespace

struct Keyboard::Settings {
    termios values;
};

Keyboard::Keyboard() {
    // Without SA_RESTART, so that a signal ends a wait.
    struct sigaction action = {};
    action.sa_handler = note;
    for (const int signal : signals)
        ::sigaction(signal, &action, nullptr);
    termios settings{};
    // A program in the background would be stopped.
    if (!in_foreground() || ::tcgetattr(STDIN_FILENO, &settings) != 0) return;
    before_ = std::make_unique<Settings>(Settings{settings});
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

Keyboard::~Keyboard() {
    if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_->values);
    for (const int signal : signals)
        std::signal(signal, SIG_DFL);
}

bool Keyboard::ends_within(std::chrono::milliseconds time) {
    pollfd keys{before_ ? STDIN_FILENO : -1, POLLIN, 0};
    const Clock::time_point end = Clock::now() + time;
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
        const int ready = ::poll(&keys, 1, static_cast<int>(std::max<long>(left.count(), 0)));
        if (signalled != 0) return true;
        if (ready == 0) return false;
        char key = 0;
        if (ready > 0 && (::read(STDIN_FILENO, &key, 1) != 1 || key == 'q')) return true;
    }
}

bool draws_on_terminal() {
    return ::isatty(STDOUT_FILENO) == 1;
}

}  // namespace scipd::tools
