// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells the parent what a child process is doing, so that the message after a timeout can say it.
// Both have the same file in memory, whose words the child replaces.
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

/// The parent's side. One owner.
class Doing {
  public:
    Doing();
    ~Doing();
    Doing(const Doing&) = delete;
    Doing& operator=(const Doing&) = delete;

    /// The file, which the child needs.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// What the child reported last; empty if nothing. Call it after the child has ended.
    [[nodiscard]] std::string last() const;

  private:
    int descriptor_;
};

/// Where a child that is another program finds the file.
inline constexpr int doing_descriptor = 3;

/// In a child: now_doing() writes to this file from now on.
void begin_doing(int descriptor);

/// `what` is, for example, "reading a.dae". Does nothing outside a child. Only the child's single
/// thread calls it.
void now_doing(std::string_view what);

}  // namespace scipd::sim
