// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/target.h"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace scipd::tools {
namespace {

/// All Ethernet models use this port.
constexpr std::string_view default_port = "10940";

bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, port);
    return error == std::errc{} && stop == end && port != 0;
}

/// HOST or HOST:PORT, where HOST may be an IPv6 address in brackets.
std::optional<TcpTarget> parse_address(std::string_view text) {
    std::string_view host = text;
    std::string_view port = default_port;
    const std::size_t bracket = text.starts_with('[') ? text.find(']') : 0;
    if (bracket == std::string_view::npos) return std::nullopt;
    if (const std::size_t colon = text.find(':', bracket); colon != std::string_view::npos) {
        host = text.substr(0, colon);
        port = text.substr(colon + 1);
    }
    if (bracket != 0) {
        if (host.size() != bracket + 1) return std::nullopt;
        host = host.substr(1, bracket - 1);
    }
    if (host.empty() || !is_port(port)) return std::nullopt;
    return TcpTarget{std::string(host), std::string(port)};
}

}  // namespace

Target parse_target(std::string_view text) {
    constexpr std::string_view scheme = "tcp://";
    if (text.starts_with(scheme)) {
        if (auto address = parse_address(text.substr(scheme.size()))) return *address;
        throw std::invalid_argument("\"" + std::string(text) +
                                    "\" is no address: write tcp://HOST:PORT");
    }
    const bool looks_like_path = text.find('/') != std::string_view::npos;
    if (looks_like_path || std::filesystem::exists(text)) return TtyTarget{std::string(text)};
    const bool says_port = text.find(':') != std::string_view::npos;
    if (auto address = parse_address(text); says_port && address) return *address;
    throw std::invalid_argument("\"" + std::string(text) +
                                "\" is no scanner: write tcp://HOST:PORT or the path of a tty");
}

}  // namespace scipd::tools
