// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where to listen or to connect. A value; any thread.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>

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

/// Where a client on this machine finds what listens there: nobody can ask for all addresses.
inline Address from_here(Address address) {
    if (address.host == "0.0.0.0") address.host = "127.0.0.1";
    if (address.host == "::") address.host = "::1";
    return address;
}

/// What the configuration names is not there, and may be later without anybody's help: an address
/// of this machine whose network is not up, or a broker.
class NotThereYet : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws NotThereYet where that is why it failed: no interface of this machine has the address.
inline void require_own_address(const std::string& what, const std::error_code& error) {
    if (error != std::errc::address_not_available) return;
    throw NotThereYet(what +
                      ": this machine has no such address now; `ip address` shows those "
                      "that it has");
}

}  // namespace scipd::daemon
