// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file of its own, because <asm/termbits.h>, which can set rates without a name, cannot be
// included beside <termios.h>.
#include "tools/set_line_rate.h"

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace scipd::tools {

bool set_line_rate(int tty, int bits_per_second) {
    termios2 settings{};
    if (::ioctl(tty, TCGETS2, &settings) != 0) return false;
    settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CIBAUD);
    settings.c_cflag |= BOTHER;
    settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(bits_per_second);
    return ::ioctl(tty, TCSETS2, &settings) == 0;
}

}  // namespace scipd::tools
