// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether a thread may do what takes long, such as reading a file: not while others wait for it.
// Asserts know. Any thread; each has its own answer.
#pragma once

#include <cassert>

namespace scipd::sim {

/// As long as one lives, its thread must be quick.
class MustBeQuick {
  public:
    MustBeQuick() { ++depth(); }
    MustBeQuick(const MustBeQuick&) = delete;
    MustBeQuick& operator=(const MustBeQuick&) = delete;
    ~MustBeQuick() { --depth(); }

    [[nodiscard]] static bool here() { return depth() > 0; }

  private:
    static int& depth() {
        thread_local int of_this_thread = 0;
        return of_this_thread;
    }
};

/// To be called first by whatever takes long.
inline void takes_long() {
    assert(!MustBeQuick::here());
}

}  // namespace scipd::sim
