// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The part of a TCP connection that a packet of a network carries. A value; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace scipd::sim {

struct Endpoint {
    std::string address;  ///< "192.168.0.10" or "[fe80::1]"
    std::uint16_t port = 0;

    bool operator<(const Endpoint& other) const {
        return std::tie(address, port) < std::tie(other.address, other.port);
    }
};

[[nodiscard]] inline std::string text_of(const Endpoint& endpoint) {
    return endpoint.address + ":" + std::to_string(endpoint.port);
}

struct TcpSegment {
    Endpoint from;
    Endpoint to;
    std::uint32_t sequence = 0;  ///< of the first byte of the payload
    bool syn = false;            ///< opens the connection; asked by a client, or (ack) answered
    bool ack = false;
    std::string_view payload;  ///< the part that was captured
};

/// What an IP packet is packed in, in the numbers of libpcap (DLT_).
[[nodiscard]] bool is_known_link(int link_type);

/// Nothing where the packet is no TCP over IPv4 or IPv6, is a fragment, or is damaged. The link
/// type is a known one.
[[nodiscard]] std::optional<TcpSegment> tcp_segment(int link_type, std::string_view packet);

}  // namespace scipd::sim
