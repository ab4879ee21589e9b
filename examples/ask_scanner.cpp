// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Asks a SCIP scanner at TCP for its name and for one scan, and prints the range straight ahead:
//   ask_scanner 127.0.0.1 10940
// scipd::protocol opens nothing itself. This program hands it a socket.
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>

#include <netdb.h>
#include <poll.h>
#include <protocol/client/driver.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

namespace client = scipd::protocol::client;
using client::Error;

class TcpTransport final : public client::Transport {
  public:
    TcpTransport(const char* host, const char* port) {
        const addrinfo hints{.ai_socktype = SOCK_STREAM};
        addrinfo* found = nullptr;
        if (::getaddrinfo(host, port, &hints, &found) != 0)
            throw Error(Error::Kind::closed, "there is no such host or port");
        socket_ = ::socket(found->ai_family, found->ai_socktype, found->ai_protocol);
        const bool connected = ::connect(socket_, found->ai_addr, found->ai_addrlen) == 0;
        ::freeaddrinfo(found);
        if (connected) return;
        ::close(socket_);
        throw Error(Error::Kind::closed, "nobody listens there");
    }
    TcpTransport(const TcpTransport&) = delete;
    TcpTransport& operator=(const TcpTransport&) = delete;
    ~TcpTransport() override { ::close(socket_); }

    void write(std::string_view bytes) override {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent < 0) throw Error(Error::Kind::closed, "the scanner is gone");
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
    }

    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override {
        pollfd ready{.fd = socket_, .events = POLLIN, .revents = 0};
        if (::poll(&ready, 1, static_cast<int>(timeout.count())) <= 0) return 0;
        const ssize_t got = ::recv(socket_, buffer.data(), buffer.size(), 0);
        if (got <= 0) throw Error(Error::Kind::closed, "the scanner is gone");
        return static_cast<std::size_t>(got);
    }

  private:
    int socket_ = -1;
};

void ask(const char* host, const char* port) {
    TcpTransport transport(host, port);
    client::Driver driver(transport);
    driver.connect();
    const client::Version version = driver.version();
    const client::Parameters parameters = driver.parameters();
    driver.switch_laser_on();
    const client::ScanMessage scan =
        driver.single_scan({.first_step = parameters.amin, .last_step = parameters.amax});
    driver.stop();
    const auto front = static_cast<std::size_t>(parameters.afrt - parameters.amin);
    std::printf("%s, serial number %s\n", parameters.model.c_str(), version.serial.c_str());
    std::printf("%zu ranges; %u mm straight ahead\n", scan.distances_mm.size(),
                scan.distances_mm.at(front));
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::fputs("usage: ask_scanner HOST PORT\n", stderr);
        return 2;
    }
    ask(argv[1], argv[2]);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "ask_scanner: %s\n", error.what());
    return 1;
}
