// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/broker_address.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

constexpr std::uint16_t plain_port = 1883;
constexpr std::uint16_t tls_port = 8883;
constexpr std::size_t longest_host = 253;
constexpr std::size_t longest_world = 64;

bool is_of_a_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
}

bool is_a_host(std::string_view text, bool in_brackets) {
    return !text.empty() && text.size() <= longest_host && std::ranges::all_of(text, [&](char c) {
        return is_of_a_word(c) || (in_brackets && c == ':');
    });
}

std::optional<std::uint16_t> port_in(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc{} || end != text.data() + text.size() || port == 0) return {};
    return port;
}

/// HOST, HOST:PORT or [IPv6]:PORT
std::optional<BrokerAddress> address_in(std::string_view text, bool tls) {
    BrokerAddress address{.port = tls ? tls_port : plain_port, .tls = tls};
    const bool in_brackets = text.starts_with('[');
    const auto end = in_brackets ? text.find(']') : text.find(':');
    if (in_brackets && end == text.npos) return {};
    const std::string_view host = in_brackets ? text.substr(1, end - 1) : text.substr(0, end);
    std::string_view rest = end == text.npos ? "" : text.substr(end + (in_brackets ? 1 : 0));
    if (!is_a_host(host, in_brackets)) return {};
    address.host = host;
    if (rest.empty()) return address;
    const auto port = rest.front() == ':' ? port_in(rest.substr(1)) : std::nullopt;
    if (!port) return {};
    address.port = *port;
    return address;
}

}  // namespace

std::string text_of(const BrokerAddress& address) {
    const bool v6 = address.host.find(':') != std::string::npos;
    return (address.tls ? "mqtts://" : "mqtt://") + (v6 ? "[" + address.host + "]" : address.host) +
           ":" + std::to_string(address.port);
}

sim::Expected<BrokerAddress> parse_broker(std::string_view text) {
    if (text.find('@') != text.npos)
        return sim::refuse("must hold no user; user_file names a file with USER:PASSWORD");
    for (const bool tls : {false, true}) {
        const std::string_view scheme = tls ? "mqtts://" : "mqtt://";
        if (!text.starts_with(scheme)) continue;
        if (auto address = address_in(text.substr(scheme.size()), tls)) return *std::move(address);
    }
    return sim::refuse(
        "must be mqtt://HOST:PORT such as mqtt://127.0.0.1:1883, or mqtts:// with "
        "TLS, not " +
        sim::quote(text));
}

sim::Expected<std::string> parse_world_name(std::string_view text) {
    const bool good = !text.empty() && text.size() <= longest_world && text.front() != '.' &&
                      std::ranges::all_of(text, is_of_a_word);
    if (good) return std::string(text);
    return sim::refuse(
        "must be up to 64 letters, digits, _ - and ., not beginning with a dot, "
        "not " +
        sim::quote(text));
}

sim::Expected<SharedWorldName> parse_broker_and_world(std::string_view text) {
    const auto scheme = text.find("://");
    const auto slash = scheme == text.npos ? text.npos : text.find('/', scheme + 3);
    if (slash == text.npos)
        return sim::refuse("must be mqtt://HOST:PORT/WORLD, not " + sim::quote(text));
    return parse_broker(text.substr(0, slash)).and_then([&](const BrokerAddress& broker) {
        return parse_world_name(text.substr(slash + 1)).map([&](const std::string& world) {
            return SharedWorldName{broker, world};
        });
    });
}

sim::Expected<BrokerUser> parse_broker_user(std::string_view line) {
    const auto colon = line.find(':');
    if (colon == line.npos || colon == 0)
        return sim::refuse("the first line of the file must be USER:PASSWORD");
    return BrokerUser{std::string(line.substr(0, colon)), std::string(line.substr(colon + 1))};
}

}  // namespace scipd::daemon
