// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells the parent what a child process is doing, so that the message after a timeout can say it.
// Both processes share the object; only the child's single thread calls now_doing().
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

    /// In the child: now_doing() writes to this object from now on.
    void begin();
    /// What the child reported last; empty if nothing. Call it after the child has ended.
    [[nodiscard]] std::string last() const;

  private:
    char* words_;
};

/// `what` is, for example, "reading a.dae". Does nothing outside a child.
void now_doing(std::string_view what);

}  // namespace scipd::sim
