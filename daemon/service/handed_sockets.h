// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sockets on which systemd listened before it started scipd, and that it has handed over
// (sd_listen_fds(3)): the client that comes first has scipd started. Where a socket listens decides
// what it is for, as the configuration has it; its name in the socket unit does not matter. systemd
// keeps the sockets open, so they stay here for as long as scipd runs. Any thread, as long as
// nobody changes the environment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/config/address.h"

namespace scipd::daemon {

class HandedSockets {
  public:
    /// Throws std::runtime_error where what systemd says of them makes no sense.
    HandedSockets();
    HandedSockets(const HandedSockets&) = delete;
    HandedSockets& operator=(const HandedSockets&) = delete;
    ~HandedSockets();

    /// A descriptor of the caller's own for the one that listens there; nothing: there is none.
    /// Throws std::system_error.
    [[nodiscard]] std::optional<int> at(const Address& address) const;
    [[nodiscard]] std::optional<int> at(const std::filesystem::path& socket) const;

    /// A warning for each that is neither one of these addresses nor this socket: nobody will
    /// answer there.
    [[nodiscard]] std::vector<std::string> unneeded(const std::vector<std::string>& addresses,
                                                    const std::filesystem::path& socket) const;

  private:
    struct Handed {
        int descriptor = -1;
        std::string name;   ///< as the socket unit calls it
        std::string where;  ///< HOST:PORT or a path; empty: nobody can connect to it
    };

    static std::string where(int descriptor);

    std::vector<Handed> sockets_;
};

}  // namespace scipd::daemon
