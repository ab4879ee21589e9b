// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file of its own, because <asm/termbits.h> cannot be included beside <termios.h>.
#include "tests/support/tty_rate.h"

#include <cerrno>
#include <system_error>

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace scipd::tests {

void set_tty_rate(int tty, int bits_per_second) {
    termios2 settings{};
    int result = ::ioctl(tty, TCGETS2, &settings);
    settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CIBAUD);
    settings.c_cflag |= BOTHER;
    settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(bits_per_second);
    if (result == 0) result = ::ioctl(tty, TCSETS2, &settings);
    if (result != 0) throw std::system_error(errno, std::generic_category(), "rate of a tty");
}

int tty_rate(int tty) {
    termios2 settings{};
    if (::ioctl(tty, TCGETS2, &settings) != 0)
        throw std::system_error(errno, std::generic_category(), "rate of a tty");
    return static_cast<int>(settings.c_ospeed);
}

}  // namespace scipd::tests
