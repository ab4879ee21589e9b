// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// This is a file of its own because <asm/termbits.h>, which knows rates without a name, cannot be
// included beside <termios.h>.
#include "daemon/link/line_rate.h"

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace scipd::daemon {
namespace {

// Linux runs a serial port at this rate where it is set to 0, "hang up" (uart_get_baud_rate).
constexpr int rate_of_none = 9600;

}  // namespace

int line_rate(int tty) {
    termios2 settings{};
    const bool known = ::ioctl(tty, TCGETS2, &settings) == 0 && settings.c_ospeed != 0;
    return known ? static_cast<int>(settings.c_ospeed) : rate_of_none;
}

}  // namespace scipd::daemon
