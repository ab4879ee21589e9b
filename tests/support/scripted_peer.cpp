// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/scripted_peer.h"

#include <array>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/sockets.h"

namespace scipd::tests {

ScriptedPeer::ScriptedPeer(std::string greeting, Then then)
    : greeting_(std::move(greeting)),
      then_(then),
      listener_(listen_on_loopback()),
      thread_([this] { serve(); }) {}

ScriptedPeer::~ScriptedPeer() {
    shutdown(listener_, SHUT_RDWR);  // accept() returns
    thread_.join();
    ::close(listener_);
}

std::string ScriptedPeer::target() const {
    return "tcp://127.0.0.1:" + std::to_string(port_of(listener_));
}

void ScriptedPeer::serve() const {
    for (;;) {
        const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
        if (client < 0) return;
        (void)send(client, greeting_.data(), greeting_.size(), MSG_NOSIGNAL);
        std::array<char, 256> ignored{};
        while (then_ == Then::hold_on && ::read(client, ignored.data(), ignored.size()) > 0) {
        }
        ::close(client);
    }
}

}  // namespace scipd::tests
