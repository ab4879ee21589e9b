// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::tests {

/// Sets a tty to any rate, also to those without a name, as some drivers do. Throws
/// std::system_error.
void set_tty_rate(int tty, int bits_per_second);

/// The rate of a tty. Throws std::system_error.
[[nodiscard]] int tty_rate(int tty);

}  // namespace scipd::tests
