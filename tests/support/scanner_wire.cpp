// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/scanner_wire.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace scipd::tests {

namespace client = protocol::client;
using std::chrono::milliseconds;
using Steady = std::chrono::steady_clock;

namespace {

int checked(int result, const char* what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

milliseconds left_until(Steady::time_point end) {
    return std::chrono::ceil<milliseconds>(std::max(end - Steady::now(), Steady::duration::zero()));
}

}  // namespace

std::uint16_t port_of(const std::string& address) {
    return static_cast<std::uint16_t>(std::stoul(address.substr(address.rfind(':') + 1)));
}

std::string local_address(const ScannerWire& wire) {
    sockaddr_in address{};
    socklen_t size = sizeof(address);
    checked(::getsockname(wire.descriptor(), reinterpret_cast<sockaddr*>(&address), &size),
            "getsockname");
    std::array<char, INET_ADDRSTRLEN> host{};
    ::inet_ntop(AF_INET, &address.sin_addr, host.data(), host.size());
    return std::string(host.data()) + ":" + std::to_string(ntohs(address.sin_port));
}

ScannerWire ScannerWire::tcp(std::uint16_t port, int receive_buffer, const char* host) {
    ScannerWire wire(checked(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), "socket"));
    if (receive_buffer > 0) {
        ::setsockopt(wire.descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer,
                     sizeof(receive_buffer));
    }
    const int yes = 1;
    ::setsockopt(wire.descriptor_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    checked(::inet_pton(AF_INET, host, &address.sin_addr), "address");
    checked(
        ::connect(wire.descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)),
        "connect");
    return wire;
}

ScannerWire ScannerWire::tty(const std::filesystem::path& path) {
    return ScannerWire(
        checked(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), "open of a tty"));
}

ScannerWire::ScannerWire(ScannerWire&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      decoder_(std::move(other.decoder_)),
      unread_(std::move(other.unread_)) {}

ScannerWire::~ScannerWire() {
    close();
}

void ScannerWire::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        bytes.remove_prefix(
            static_cast<std::size_t>(checked(static_cast<int>(count), "write to a scanner")));
    }
}

std::size_t ScannerWire::read(std::span<char> buffer, milliseconds timeout) {
    pollfd event{.fd = descriptor_, .events = POLLIN};
    if (::poll(&event, 1, static_cast<int>(timeout.count())) <= 0) return 0;
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count <= 0) throw std::runtime_error("the scanner has ended the connection");
    return static_cast<std::size_t>(count);
}

std::optional<client::Message> ScannerWire::next_message(milliseconds timeout) {
    const auto end = Steady::now() + timeout;
    std::array<char, 4096> buffer;
    for (;;) {
        std::string_view bytes = unread_;
        auto message = decoder_.next(bytes);
        unread_.erase(0, unread_.size() - bytes.size());
        if (message) return message;
        const std::size_t count = read(buffer, left_until(end));
        if (count == 0) return std::nullopt;
        unread_.append(buffer.data(), count);
    }
}

std::string ScannerWire::ask(const std::string& request) {
    write(request + "\n");
    const auto end = Steady::now() + patience;
    while (auto message = next_message(left_until(end))) {
        if (message->echo == request && message->status != "99") return message->status;
    }
    throw std::runtime_error("no answer to " + request);
}

client::ScanMessage ScannerWire::next_scan() {
    const auto message = next_message();
    if (!message) throw std::runtime_error("no scan comes");
    auto parsed = client::parse_scan(*message);
    if (const auto* fault = std::get_if<std::string>(&parsed)) throw std::runtime_error(*fault);
    return std::get<client::ScanMessage>(std::move(parsed));
}

bool ScannerWire::ends() {
    const auto end = Steady::now() + patience;
    std::array<char, 4096> buffer;
    try {
        while (Steady::now() < end)
            (void)read(buffer, left_until(end));
    } catch (const std::runtime_error&) {
        return true;
    }
    return false;
}

void ScannerWire::half_close() const {
    checked(::shutdown(descriptor_, SHUT_WR), "shutdown");
}

void ScannerWire::close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

void ScannerWire::abort() {
    const linger at_once{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
    close();
}

}  // namespace scipd::tests
