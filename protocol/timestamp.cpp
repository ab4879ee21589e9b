// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/timestamp.h"

#include <array>
#include <cstdio>

namespace scipd::protocol {

std::string hexadecimal_timestamp(Uptime now, Uptime zero) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "%06X", static_cast<unsigned>(timestamp_ms(now, zero)));
    return text.data();
}

}  // namespace scipd::protocol
