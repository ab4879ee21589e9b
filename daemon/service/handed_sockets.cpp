// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service/handed_sockets.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <boost/asio/ip/tcp.hpp>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

int of_our_own(int descriptor) {
    const int ours = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (ours < 0) throw std::system_error(errno, std::generic_category(), "a socket of systemd");
    return ours;
}

bool listens(int descriptor, int family) {
    constexpr int listening = 1;
    return ::sd_is_socket(descriptor, family, SOCK_STREAM, listening) > 0;
}

std::string path_of(int descriptor) {
    sockaddr_un name{};
    socklen_t size = sizeof(name);
    if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&name), &size) != 0) return {};
    const auto most = static_cast<std::size_t>(size) - offsetof(sockaddr_un, sun_path);
    const std::string_view path{name.sun_path, std::min(most, sizeof(name.sun_path))};
    return std::string{path.substr(0, path.find('\0'))};  // empty: it is no file
}

std::string address_of(int descriptor) {
    boost::asio::ip::tcp::endpoint endpoint;
    auto size = static_cast<socklen_t>(endpoint.capacity());
    if (::getsockname(descriptor, endpoint.data(), &size) != 0) return {};
    endpoint.resize(size);
    return text_of(Address{endpoint.address().to_string(), endpoint.port()});
}

/// By whatever name of its folder.
bool is_socket_at(const fs::path& where, const fs::path& socket) {
    std::error_code ignored;
    return where.is_absolute() && where.filename() == socket.filename() &&
           fs::equivalent(where.parent_path(), fs::absolute(socket).parent_path(), ignored);
}

}  // namespace

HandedSockets::HandedSockets() {
    constexpr int keep_environment = 0;
    char** names = nullptr;
    const int count = ::sd_listen_fds_with_names(keep_environment, &names);
    if (count < 0) {
        throw std::runtime_error(
            "cannot take the sockets of systemd: " + std::generic_category().message(-count) +
            "; LISTEN_FDS must tell their number, and LISTEN_FDNAMES as many names");
    }
    for (int i = 0; i < count; ++i) {
        const int descriptor = SD_LISTEN_FDS_START + i;
        sockets_.push_back({descriptor, names[i], where(descriptor)});
        std::free(names[i]);
    }
    std::free(names);
}

HandedSockets::~HandedSockets() {
    for (const Handed& socket : sockets_)
        ::close(socket.descriptor);
}

std::string HandedSockets::where(int descriptor) {
    if (listens(descriptor, AF_UNIX)) return path_of(descriptor);
    const bool tcp = listens(descriptor, AF_INET) || listens(descriptor, AF_INET6);
    return tcp ? address_of(descriptor) : std::string{};
}

std::optional<int> HandedSockets::at(const Address& address) const {
    const auto found = std::ranges::find(sockets_, text_of(address), &Handed::where);
    if (found == sockets_.end()) return std::nullopt;
    return of_our_own(found->descriptor);
}

std::optional<int> HandedSockets::at(const fs::path& socket) const {
    const auto found = std::ranges::find_if(
        sockets_, [&](const Handed& handed) { return is_socket_at(handed.where, socket); });
    if (found == sockets_.end()) return std::nullopt;
    return of_our_own(found->descriptor);
}

std::vector<std::string> HandedSockets::unneeded(const std::vector<std::string>& addresses,
                                                 const fs::path& socket) const {
    std::vector<std::string> warnings;
    for (const Handed& handed : sockets_) {
        const bool needed = std::ranges::find(addresses, handed.where) != addresses.end() ||
                            is_socket_at(handed.where, socket);
        if (needed) continue;
        const std::string name = " (" + sim::quote(handed.name) + ")";
        warnings.push_back(
            handed.where.empty()
                ? "systemd hands over descriptor " + std::to_string(handed.descriptor) + name +
                      ", which is no listening TCP or Unix stream socket; take it out of the "
                      "socket unit"
                : "systemd hands over a socket on " + handed.where + name +
                      ", where nothing of the configuration listens, so that its clients wait in "
                      "vain; name it there as tcp, http or control, or take it out of the socket "
                      "unit");
    }
    return warnings;
}

}  // namespace scipd::daemon
