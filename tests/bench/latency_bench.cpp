// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures how long a client waits for an answer. It compares VV with a bare echo server. Both are
// processes of their own and are asked in turns, so that other load on the machine affects both
// alike. For QT and PP it uses a UST-10LX, which answers at least 0.4 ms after the request.
//
//   build/release/bin/latency_bench
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/sockets.h"

namespace {

using namespace scipd::tests;
using boost::asio::ip::tcp;
using Microseconds = std::chrono::duration<double, std::micro>;

/// The shortest echo server in Boost.Asio's own style, for one client, as a process.
class EchoServer {
  public:
    EchoServer() : listener_(listen_on_loopback()), parent_(::getpid()), child_(::fork()) {
        if (child_ == 0) serve();
    }
    EchoServer(const EchoServer&) = delete;
    EchoServer& operator=(const EchoServer&) = delete;
    ~EchoServer() {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
        ::close(listener_);
    }

    [[nodiscard]] std::uint16_t port() const {
        return static_cast<std::uint16_t>(port_of(listener_));
    }

  private:
    [[noreturn]] void serve() {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent_) ::_exit(1);
        boost::asio::io_context io{1};
        tcp::acceptor acceptor(io, tcp::v4(), listener_);
        tcp::socket socket = acceptor.accept();
        socket.set_option(tcp::no_delay(true));
        std::array<char, 4096> buffer{};
        const std::function<void()> read = [&] {
            socket.async_read_some(boost::asio::buffer(buffer), [&](auto error, std::size_t n) {
                if (error) return io.stop();
                boost::asio::async_write(socket, boost::asio::buffer(buffer, n),
                                         [&](auto, std::size_t) { read(); });
            });
        };
        read();
        io.run();
        ::_exit(0);
    }

    int listener_;
    pid_t parent_;
    pid_t child_;
};

/// The time from the request to the last byte of its answer.
Microseconds round_trip(ScannerWire& wire, std::string_view request, std::string_view answer_end) {
    std::array<char, 4096> buffer;
    std::string answer;
    const auto start = std::chrono::steady_clock::now();
    wire.write(request);
    while (!answer.ends_with(answer_end))
        answer.append(buffer.data(), wire.read(buffer, ScannerWire::patience));
    return std::chrono::steady_clock::now() - start;
}

double quantile_us(std::vector<Microseconds>& times, double share) {
    const auto nth = static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
    std::nth_element(times.begin(), times.begin() + nth, times.end());
    return times[static_cast<std::size_t>(nth)].count();
}

void print(const char* what, std::vector<Microseconds>& times) {
    std::printf("%-34s median %7.1f us   p99 %7.1f us   max %7.1f us\n", what,
                quantile_us(times, 0.5), quantile_us(times, 0.99), quantile_us(times, 1.0));
}

void compare_with_echo() {
    constexpr int rounds = 20000;
    const EchoServer echo_server;
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tcp({"--timing", "ideal"}));
    ScannerWire echo = ScannerWire::tcp(echo_server.port());
    ScannerWire scanner = ScannerWire::tcp(daemon.port());
    std::vector<Microseconds> echo_times;
    std::vector<Microseconds> scanner_times;
    for (int i = 0; i < rounds; ++i) {
        echo_times.push_back(round_trip(echo, "VV\n", "VV\n"));
        scanner_times.push_back(round_trip(scanner, "VV\n", "\n\n"));
    }
    print("bare echo of VV", echo_times);
    print("scipd's VV, ideal timing", scanner_times);
    std::printf("%-34s %.2f (to be at most 1.5)\n", "ratio of the medians",
                quantile_us(scanner_times, 0.5) / quantile_us(echo_times, 0.5));
}

void time_requests() {
    constexpr int rounds = 500;
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tcp());
    ScannerWire scanner = ScannerWire::tcp(daemon.port());
    for (const char* request : {"QT", "PP"}) {
        std::vector<Microseconds> times;
        for (int i = 0; i < rounds; ++i) {
            // Asks at all phases of the mirror, in no particular order.
            std::this_thread::sleep_for(std::chrono::microseconds(i * 617 % 2000));
            times.push_back(round_trip(scanner, std::string(request) + "\n", "\n\n"));
        }
        print((std::string(request) + " of a UST-10LX (far below 5 ms)").c_str(), times);
    }
}

/// Keeps everything on one processor. The kernel puts a forked process beside its client, but a
/// process that was started on its own elsewhere. Waking an idle processor of a virtual machine
/// takes 45 us, three times as long as either server needs.
void stay_on_this_processor() {
    cpu_set_t processors;
    CPU_ZERO(&processors);
    CPU_SET(::sched_getcpu(), &processors);
    if (::sched_setaffinity(0, sizeof(processors), &processors) != 0) {
        std::puts("cannot stay on one processor: the ratio says nothing");
    }
}

}  // namespace

int main() {
    stay_on_this_processor();
    compare_with_echo();
    time_requests();
}
