// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/scanner_line.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "protocol/client/error.h"

namespace scipd::testing {
namespace {

using protocol::client::Error;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

// What needs no time to go on is there by then, in lockstep too.
constexpr milliseconds at_once{10};
constexpr milliseconds reply_patience{1000};

int checked(int result, const std::string& what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

Error gone() {
    return {Error::Kind::closed, "the scanner has closed the connection"};
}

}  // namespace

ScannerLine::ScannerLine(int descriptor, Meanwhile meanwhile)
    : descriptor_(descriptor), meanwhile_(std::move(meanwhile)) {}

ScannerLine::ScannerLine(ScannerLine&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), meanwhile_(std::move(other.meanwhile_)) {}

ScannerLine::~ScannerLine() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

ScannerLine ScannerLine::tcp(const std::string& address, Meanwhile meanwhile) {
    ScannerLine line(checked(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), "socket"),
                     std::move(meanwhile));
    const std::size_t colon = address.rfind(':');
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1))));
    if (::inet_pton(AF_INET, address.substr(0, colon).c_str(), &place.sin_addr) != 1)
        throw std::system_error(EAFNOSUPPORT, std::generic_category(), address);
    checked(::connect(line.descriptor_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)),
            address);
    return line;
}

ScannerLine ScannerLine::tty(const std::string& path, Meanwhile meanwhile) {
    ScannerLine line(checked(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), path),
                     std::move(meanwhile));
    termios settings{};
    checked(::tcgetattr(line.descriptor_, &settings), path);
    ::cfmakeraw(&settings);
    checked(::tcsetattr(line.descriptor_, TCSANOW, &settings), path);
    return line;
}

void ScannerLine::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0) throw gone();
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    has_asked_ = true;
}

std::size_t ScannerLine::read(std::span<char> buffer, milliseconds timeout) {
    const auto now = steady_clock::now();
    timeout = std::clamp(std::chrono::ceil<milliseconds>(end_ - now), milliseconds(0), timeout);
    const auto end = now + timeout;
    // Most replies come although time stands still. Time that went on before scipd has read the
    // request would make two runs differ.
    const auto first_wait = has_asked_ ? reply_patience : at_once;
    bool comes = comes_within(meanwhile_ ? std::min(first_wait, timeout) : timeout);
    while (!comes && meanwhile_ && steady_clock::now() < end) {
        meanwhile_();
        comes = comes_within(at_once);
    }
    if (!comes) return 0;
    has_asked_ = false;
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count <= 0) throw gone();
    return static_cast<std::size_t>(count);
}

bool ScannerLine::comes_within(milliseconds timeout) const {
    pollfd event{.fd = descriptor_, .events = POLLIN, .revents = 0};
    return ::poll(&event, 1, static_cast<int>(timeout.count())) > 0;
}

}  // namespace scipd::testing
