// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/loopback_scanner.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "protocol/device_state.h"
#include "protocol/session.h"
#include "tests/support/sockets.h"

namespace scipd::tests {
namespace {

using protocol::Uptime;

/// A descriptor and the session behind it.
class Door {
  public:
    Door(const protocol::DeviceProfile& profile, protocol::DeviceState& device)
        : session_(profile, device) {}

    [[nodiscard]] protocol::Session& session() { return session_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    void open(int descriptor) { descriptor_ = descriptor; }

    void read_requests(Uptime now) {
        std::array<char, 512> bytes{};
        const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
        if (count > 0)
            return session_.receive({bytes.data(), static_cast<std::size_t>(count)}, now);
        ::close(std::exchange(descriptor_, -1));
        session_.close();
    }
    void send_messages() {
        while (const auto action = session_.next_action()) {
            if (const auto* message = std::get_if<protocol::Send>(&*action))
                write_all(message->bytes);
        }
    }

  private:
    void write_all(std::string_view bytes) const {
        while (!bytes.empty() && descriptor_ >= 0) {
            const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
            if (count <= 0) return;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }

    protocol::Session session_;
    int descriptor_ = -1;
};

}  // namespace

LoopbackScanner::LoopbackScanner(protocol::DeviceProfile profile,
                                 std::function<Reading(int step)> reading)
    : profile_(std::move(profile)),
      reading_(std::move(reading)),
      listener_(listen_on_loopback()),
      pty_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)),
      port_(port_of(listener_)) {
    grantpt(pty_);
    unlockpt(pty_);
    tty_ = ptsname(pty_);
    pty_kept_open_ = ::open(tty_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    tcgetattr(pty_kept_open_, &settings);
    cfmakeraw(&settings);
    tcsetattr(pty_kept_open_, TCSANOW, &settings);
    thread_ = std::thread([this] { serve(); });
}

LoopbackScanner::~LoopbackScanner() {
    stop_ = true;
    thread_.join();
    for (const int descriptor : {listener_, pty_, pty_kept_open_})
        ::close(descriptor);
}

std::string LoopbackScanner::tcp_target() const {
    return "tcp://127.0.0.1:" + std::to_string(port_);
}

void LoopbackScanner::serve() {
    const auto power_up = std::chrono::steady_clock::now();
    std::vector<std::uint32_t> distance;
    std::vector<std::uint32_t> intensity;
    for (int step = 0; step <= profile_.last_step; ++step) {
        const Reading reading = reading_(step);
        distance.push_back(reading.distance_mm);
        intensity.push_back(reading.intensity);
    }
    protocol::DeviceState device;
    std::array<Door, 2> doors{{{profile_, device}, {profile_, device}}};
    Door& tcp = doors[0];
    doors[1].open(pty_);
    protocol::Turn turn{};
    while (!stop_) {
        std::array<pollfd, 3> polled{{{tcp.descriptor() < 0 ? listener_ : -1, POLLIN, 0},
                                      {tcp.descriptor(), POLLIN, 0},
                                      {pty_, POLLIN, 0}}};
        constexpr int patience_ms = 2;
        poll(polled.data(), polled.size(), patience_ms);
        const Uptime now = std::chrono::steady_clock::now() - power_up;
        if (polled[0].revents != 0) tcp.open(accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC));
        for (std::size_t i = 0; i < doors.size(); ++i) {
            if (polled[i + 1].revents != 0) doors[i].read_requests(now);
        }
        for (; turn.start + profile_.scan_period <= now; turn.start += profile_.scan_period) {
            const protocol::ScanView scan{turn, 0, distance, intensity};
            for (Door& door : doors) {
                if (door.session().turn_complete(turn)) door.session().take(scan, now);
            }
        }
        for (Door& door : doors) {
            door.session().advance(now);
            door.send_messages();
        }
    }
    if (tcp.descriptor() >= 0) ::close(tcp.descriptor());
}

}  // namespace scipd::tests
