// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rate of a tty, whichever it is. Nothing is kept; any thread.
#pragma once

namespace scipd::daemon {

/// The rate that a tty is set to, in bits per second, whichever it is: also 250000 and others that
/// POSIX has no name for. Of a pseudo-terminal either end will do.
[[nodiscard]] int line_rate(int tty);

}  // namespace scipd::daemon
