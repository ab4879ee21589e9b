// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tcp_peer.h"

#include <algorithm>

#include <linux/sockios.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace scipd::daemon {
namespace {

std::uint64_t acknowledged_bytes(int socket) {
    tcp_info info{};
    socklen_t size = sizeof(info);
    ::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size);
    return info.tcpi_bytes_acked;
}

bool something_waits(int socket) {
    int unacknowledged = 0;
    return ::ioctl(socket, SIOCOUTQ, &unacknowledged) == 0 && unacknowledged > 0;
}

// The kernel counts whole seconds: a short bound is rounded up.
void keep_alive(int socket, std::chrono::nanoseconds bound) {
    const auto seconds = static_cast<int>(std::chrono::ceil<std::chrono::seconds>(bound).count());
    const int interval = std::max(seconds / 4, 1);
    const int questions = std::max(seconds / interval - 1, 1);
    const auto set = [&](int level, int option, int value) {
        ::setsockopt(socket, level, option, &value, sizeof(value));
    };
    set(IPPROTO_TCP, TCP_KEEPIDLE, interval);
    set(IPPROTO_TCP, TCP_KEEPINTVL, interval);
    set(IPPROTO_TCP, TCP_KEEPCNT, questions);
    set(SOL_SOCKET, SO_KEEPALIVE, 1);
}

}  // namespace

TcpPeer::TcpPeer(int socket, std::chrono::nanoseconds bound) : socket_(socket), bound_(bound) {
    keep_alive(socket, bound);
}

bool TcpPeer::stalled() {
    const auto now = Steady::now();
    const std::uint64_t acknowledged = acknowledged_bytes(socket_);
    if (acknowledged != acknowledged_ || !something_waits(socket_)) since_ = now;
    acknowledged_ = acknowledged;
    return now - since_ >= bound_;
}

}  // namespace scipd::daemon
