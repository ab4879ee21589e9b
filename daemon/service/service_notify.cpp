// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service/service_notify.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include "sim/text/quote.h"

namespace scipd::daemon::service_notify {
namespace {

constexpr int keep_environment = 0;
/// systemd passes over a message of more than 4096 bytes.
constexpr std::size_t longest_status = 2048;

/// What nobody has taken yet.
std::string untold;

struct Listener {
    sockaddr_un address;
    socklen_t size;
};

/// Where systemd listens; nothing: nowhere. @ stands for the zero that begins an abstract name.
std::optional<Listener> listener() {
    const char* const path = std::getenv("NOTIFY_SOCKET");
    const std::string_view name = path != nullptr ? path : "";
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    if (name.empty() || name.size() >= sizeof(address.sun_path)) return std::nullopt;
    name.copy(address.sun_path, name.size());
    if (name.front() == '@') address.sun_path[0] = '\0';
    return Listener{address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size())};
}

/// False: whoever listens does not read at present. sd_notify() would wait until it does, and all
/// scanners with it.
bool send(const std::string& assignments) {
    const auto to = listener();
    if (!to) return true;
    const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0) return false;
    const ssize_t sent = ::sendto(socket, assignments.data(), assignments.size(), MSG_NOSIGNAL,
                                  reinterpret_cast<const sockaddr*>(&to->address), to->size);
    const bool waits = sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS);
    ::close(socket);
    return !waits;
}

constexpr std::string_view is_ready = "READY=1\n";

/// What is told later supersedes what could not be told, but for is_ready (status()).
void tell(const std::string& assignments) {
    untold = send(assignments) ? std::string{} : assignments;
}

/// A line end would begin another assignment.
std::string status_line(const std::string& text) {
    std::string line = "STATUS=" + sim::shown(text);
    line.resize(sim::whole_characters(line, longest_status));
    std::ranges::replace(line, '\n', ' ');
    return line;
}

/// On the clock by which systemd tells this reload from an earlier one.
std::int64_t monotonic_us() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace

bool is_heard() {
    return listener().has_value();
}

// Without is_ready systemd would wait for ever, and end scipd.
void status(const std::string& text) {
    const bool owes_ready = untold.starts_with(is_ready);
    tell((owes_ready ? std::string(is_ready) : std::string{}) + status_line(text));
}

void loading(const std::string& status, std::chrono::seconds patience) {
    const std::chrono::microseconds patience_us = patience;
    tell("EXTEND_TIMEOUT_USEC=" + std::to_string(patience_us.count()) + "\n" + status_line(status));
}

void ready(const std::string& status) {
    tell(std::string(is_ready) + status_line(status));
}

void reloading(const std::string& status) {
    tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(monotonic_us()) + "\n" +
         status_line(status));
}

void stopping() {
    tell("STOPPING=1\n" + status_line("ends"));
}

std::optional<std::chrono::microseconds> watchdog() {
    std::uint64_t interval_us = 0;
    if (::sd_watchdog_enabled(keep_environment, &interval_us) <= 0) return std::nullopt;
    constexpr std::uint64_t a_year_us = 31'536'000'000'000;
    return std::chrono::microseconds(std::min(interval_us, a_year_us));
}

void feed_watchdog() {
    (void)send("WATCHDOG=1");
}

void tell_again() {
    if (!untold.empty()) tell(std::string(untold));
}

}  // namespace scipd::daemon::service_notify
