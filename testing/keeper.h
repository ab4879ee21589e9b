// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The process between a test and its scipd. It runs scipd as its child, ends it and removes its
// folder when the test asks for that or is gone in whatever way: killed, timed out, or ended
// without a word. So no scipd is ever looked for by its name, and none is left behind.
//
//   test ──fork──► keeper ──fork──► scipd
//     └─ messages ──┘ └─ PR_SET_PDEATHSIG ─┘
//
// A signal for the death of a parent alone would not do: it comes when the thread that has forked
// ends. The keeper is forked from a program with any threads, so it allocates nothing.
#pragma once

namespace scipd::testing {

/// All is made before the fork.
struct KeeperOrders {
    const char* folder;        ///< absolute; removed at the end
    char* const* command;      ///< of scipd
    char* const* environment;  ///< of scipd
    /// A socket that keeps messages apart. The keeper tells an int, the number of scipd, and, when
    /// it has ended, another, its status as of waitpid(). Any message to it ends scipd; the end of
    /// the connection ends the keeper.
    int messages;
    int test;     ///< a descriptor of the process of the test, which can be read when it has ended
    int output;   ///< standard output of scipd
    int log;      ///< standard error of scipd
    int nothing;  ///< standard input of scipd
};

/// What the forked process does, to its end.
[[noreturn]] void keep(const KeeperOrders& orders) noexcept;

/// A descriptor that can be read when this process has ended; -1 before Linux 5.3.
[[nodiscard]] int open_process(int pid) noexcept;

}  // namespace scipd::testing
