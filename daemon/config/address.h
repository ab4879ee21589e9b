// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where to listen. A value; any thread.
#pragma once

#include <cstdint>
#include <string>

namespace scipd::daemon {

/// Port 0 takes a free one.
struct Address {
    std::string host;  ///< in numbers, IPv6 without brackets
    std::uint16_t port = 0;

    bool operator==(const Address&) const = default;
};

/// As users write it: "127.0.0.1:10940", "[::1]:10940".
inline std::string text_of(const Address& address) {
    const bool v6 = address.host.find(':') != std::string::npos;
    return (v6 ? "[" + address.host + "]" : address.host) + ":" + std::to_string(address.port);
}

/// Whether only programs on this machine reach it. The address is written as parse_address() does.
inline bool is_loopback(const Address& address) {
    return address.host.starts_with("127.") || address.host == "::1";
}

}  // namespace scipd::daemon
