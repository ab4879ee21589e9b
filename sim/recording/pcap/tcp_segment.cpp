// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/tcp_segment.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

#include "sim/recording/file/byte_reader.h"

namespace scipd::sim {
namespace {

// Link types, as libpcap numbers them.
constexpr int link_null = 0;
constexpr int link_ethernet = 1;
constexpr int link_raw = 12;
constexpr int link_loop = 108;
constexpr int link_linux_cooked = 113;
constexpr int link_ipv4 = 228;
constexpr int link_ipv6 = 229;
constexpr int link_linux_cooked_2 = 276;

constexpr std::uint16_t ether_ipv4 = 0x0800;
constexpr std::uint16_t ether_ipv6 = 0x86DD;
constexpr std::uint8_t protocol_tcp = 6;

ByteReader network_order(std::string_view bytes) {
    return ByteReader(bytes, std::endian::big);
}

/// The IP packet within an Ethernet frame, behind any tags of VLANs.
std::string_view behind_ethernet(std::string_view frame) {
    ByteReader reader = network_order(frame);
    reader.skip(12);
    auto type = reader.number<std::uint16_t>();
    while ((type == 0x8100 || type == 0x88A8) && !reader.too_short()) {
        reader.skip(2);
        type = reader.number<std::uint16_t>();
    }
    return type == ether_ipv4 || type == ether_ipv6 ? reader.rest() : std::string_view{};
}

std::string_view ip_packet(int link_type, std::string_view packet) {
    const auto behind = [&](std::size_t count) {
        return packet.substr(std::min(count, packet.size()));
    };
    switch (link_type) {
        case link_ethernet:
            return behind_ethernet(packet);
        case link_null:
        case link_loop:
            return behind(4);
        case link_linux_cooked:
            return behind(16);
        case link_linux_cooked_2:
            return behind(20);
        default:
            return packet;
    }
}

std::string ipv4_text(std::string_view address) {
    const auto part = [&](std::size_t i) {
        return std::to_string(static_cast<unsigned char>(address[i]));
    };
    return part(0) + "." + part(1) + "." + part(2) + "." + part(3);
}

/// All eight groups: these names need only be the same each time.
std::string ipv6_text(std::string_view address) {
    ByteReader reader = network_order(address);
    std::string text = "[";
    while (!reader.at_end()) {
        std::array<char, 8> group{};
        std::snprintf(group.data(), group.size(), "%x", reader.number<std::uint16_t>());
        text.append(text.size() > 1 ? ":" : "").append(group.data());
    }
    return text + "]";
}

/// Frames may be longer than the packet in them. Network cards that cut large packets leave 0.
std::string_view cut_to(std::string_view packet, std::size_t length) {
    return length == 0 ? packet : packet.substr(0, length);
}

/// The addresses go into the segment; the TCP packet is returned, empty if there is none.
std::string_view read_ipv4(std::string_view packet, TcpSegment& segment) {
    ByteReader reader = network_order(packet);
    const std::size_t header = (reader.number<std::uint8_t>() & 0x0FU) * std::size_t{4};
    reader.skip(1);
    const auto length = reader.number<std::uint16_t>();
    reader.skip(2);
    const auto fragment = reader.number<std::uint16_t>();
    reader.skip(1);
    const auto protocol = reader.number<std::uint8_t>();
    reader.skip(2);
    const std::string_view from = reader.take(4);
    const std::string_view to = reader.take(4);
    const bool is_fragment = (fragment & 0x3FFFU) != 0;
    if (reader.too_short() || protocol != protocol_tcp || is_fragment || header < 20) return {};
    segment.from.address = ipv4_text(from);
    segment.to.address = ipv4_text(to);
    packet = cut_to(packet, length);
    return packet.substr(std::min(header, packet.size()));
}

std::string_view read_ipv6(std::string_view packet, TcpSegment& segment) {
    constexpr std::size_t header = 40;
    ByteReader reader = network_order(packet);
    reader.skip(4);
    const auto length = reader.number<std::uint16_t>();
    const auto next_header = reader.number<std::uint8_t>();
    reader.skip(1);
    const std::string_view from = reader.take(16);
    const std::string_view to = reader.take(16);
    if (reader.too_short() || next_header != protocol_tcp) return {};
    segment.from.address = ipv6_text(from);
    segment.to.address = ipv6_text(to);
    return cut_to(packet, length == 0 ? 0 : header + length).substr(header);
}

std::string_view read_ip(std::string_view packet, TcpSegment& segment) {
    if (packet.empty()) return {};
    switch (static_cast<unsigned char>(packet.front()) >> 4) {
        case 4:
            return read_ipv4(packet, segment);
        case 6:
            return read_ipv6(packet, segment);
        default:
            return {};
    }
}

}  // namespace

bool is_known_link(int link_type) {
    constexpr std::array known = {link_null,         link_ethernet, link_raw,  link_loop,
                                  link_linux_cooked, link_ipv4,     link_ipv6, link_linux_cooked_2};
    return std::ranges::find(known, link_type) != known.end();
}

std::optional<TcpSegment> tcp_segment(int link_type, std::string_view packet) {
    TcpSegment segment;
    ByteReader reader = network_order(read_ip(ip_packet(link_type, packet), segment));
    const std::string_view tcp = reader.rest();
    segment.from.port = reader.number<std::uint16_t>();
    segment.to.port = reader.number<std::uint16_t>();
    segment.sequence = reader.number<std::uint32_t>();
    reader.skip(4);
    const std::size_t header = (reader.number<std::uint8_t>() >> 4) * std::size_t{4};
    const auto flags = reader.number<std::uint8_t>();
    if (reader.too_short() || header < 20) return std::nullopt;
    segment.syn = (flags & 0x02U) != 0;
    segment.ack = (flags & 0x10U) != 0;
    segment.payload = tcp.substr(std::min(header, tcp.size()));
    return segment;
}

}  // namespace scipd::sim
