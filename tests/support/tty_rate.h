// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::tests {

/// Sets a tty to any rate, also to those without a name, as a driver does that knows what it wants.
/// Throws std::system_error.
void set_tty_rate(int tty, int bits_per_second);

/// The rate that a tty is set to. Throws std::system_error.
[[nodiscard]] int tty_rate(int tty);

}  // namespace scipd::tests
