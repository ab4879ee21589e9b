// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/presence.h"

#include <string_view>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

namespace scipd::daemon {

bool Presence::has_gone(int socket) {
    constexpr std::string_view interim = "HTTP/1.1 102 Processing\r\n\r\n";
    pollfd state{socket, POLLRDHUP, 0};  // errors and both ends closed are told in any case
    if (::poll(&state, 1, 0) != 1) return false;
    if ((state.revents & (POLLERR | POLLHUP)) != 0) return true;
    if (std::exchange(may_ask_, false))
        ::send(socket, interim.data(), interim.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return false;
}

}  // namespace scipd::daemon
