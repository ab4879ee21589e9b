// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a child process is at, for the words of whoever has waited long enough for it. The object
// is shared by both processes; now_doing() is for the child's only thread.
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

class Doing {
  public:
    Doing();
    ~Doing();
    Doing(const Doing&) = delete;
    Doing& operator=(const Doing&) = delete;

    /// In the child: what it says from now on is said here.
    void begin();
    /// What was said last; empty where nothing was. For when the child has ended.
    [[nodiscard]] std::string last() const;

  private:
    char* words_;
};

/// "reading a.dae"; said to nobody outside of a child.
void now_doing(std::string_view what);

}  // namespace scipd::sim
