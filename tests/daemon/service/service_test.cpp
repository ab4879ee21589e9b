// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When the watchdog is fed. tests/systemd/ has the rest of what systemd hears.
#include "daemon/service/service.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <variant>

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "daemon/config/config.h"
#include "daemon/device/device.h"
#include "daemon/rig/rig.h"
#include "daemon/rig/served.h"
#include "daemon/rig/simulation.h"
#include "daemon/service/service_notify.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// systemd, as long as this is there.
class Listener {
  public:
    Listener() : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
        sockaddr_un name{.sun_family = AF_UNIX, .sun_path = {}};
        const std::string path = directory_.path() / "notify";
        path.copy(name.sun_path, sizeof(name.sun_path) - 1);
        if (::bind(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0)
            throw std::runtime_error("no socket");
        ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
        ::setenv("WATCHDOG_USEC", "400000", 1);
        ::unsetenv("WATCHDOG_PID");
    }
    ~Listener() {
        ::unsetenv("NOTIFY_SOCKET");
        ::unsetenv("WATCHDOG_USEC");
        ::close(socket_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// Empty: it was told nothing more.
    std::string hear() {
        std::array<char, 16'384> message;
        const ssize_t size = ::recv(socket_, message.data(), message.size(), 0);
        return {message.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
    }

    /// How often it was fed since the last question.
    int meals() {
        int count = 0;
        for (std::string told = hear(); !told.empty(); told = hear())
            count += told == "WATCHDOG=1";
        return count;
    }

  private:
    tests::TempDir directory_;
    int socket_;
};

/// Its alarms never ring.
class BrokenClock : public Clock {
  public:
    explicit BrokenClock(const Clock& right) : right_(right) {}
    [[nodiscard]] sim::Time now() const override { return right_.now(); }
    [[nodiscard]] std::unique_ptr<Alarm> make_alarm() override {
        class Dumb : public Alarm {
            void set(sim::Time, Call) override {}
            void cancel() override {}
        };
        return std::make_unique<Dumb>();
    }

  private:
    const Clock& right_;
};

// More than 4096 bytes would be passed over as a whole.
TEST(Service, IsReadyHoweverMuchThereIsToSay) {
    Listener systemd;
    service_notify::ready("first\nsecond" + std::string(10'000, 'x'));
    const std::string told = systemd.hear();
    EXPECT_TRUE(told.starts_with("READY=1\nSTATUS=first secondxxx")) << told.substr(0, 40);
    EXPECT_GT(told.size(), 2000U);
    EXPECT_LT(told.size(), 4096U);
}

// The scanners would wait with it.
TEST(Service, WaitsForNobodyWhoDoesNotRead) {
    Listener systemd;
    for (int i = 0; i < 2000; ++i)
        service_notify::status("number " + std::to_string(i));
    service_notify::ready("the last");
    for (int i = 0; i < 2000; ++i)
        service_notify::feed_watchdog();
    std::string latest;
    const auto hear_all = [&] {
        for (std::string told = systemd.hear(); !told.empty(); told = systemd.hear())
            latest = told;
    };
    hear_all();
    EXPECT_TRUE(latest.starts_with("STATUS=number ")) << latest;
    service_notify::tell_again();
    hear_all();
    EXPECT_EQ(latest, "READY=1\nSTATUS=the last");
    latest.clear();
    service_notify::tell_again();
    hear_all();
    EXPECT_EQ(latest, "");
}

TEST(Service, FeedsTheWatchdogUntilAScanLoopIsStuck) {
    Listener systemd;
    boost::asio::io_context io;
    Rig rig(io.get_executor(), ClockKind::wall);
    Config config;
    config.scene = SCIPD_SCENES "/square_room.sdf";
    SensorConfig sensor = ideal_sensor();
    sensor.tcp = Address{"127.0.0.1", 0};
    config.robots.push_back({.name = "robot", .sensors = {sensor}});
    rig.apply(config);
    Simulation& simulation = rig.simulation();
    Service service(io.get_executor(), served(simulation));
    service.ready();

    Station& station = *simulation.stations.front();
    auto& device = *std::get<std::unique_ptr<Device>>(station.sensor);
    auto client = device.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    const auto is_fed = [&] { return systemd.meals() > 0; };
    EXPECT_TRUE(run_until(io, [&] { return device.counts().scans > 3; }));
    for (int meal = 0; meal < 5; ++meal)
        EXPECT_TRUE(run_until(io, is_fed));

    BrokenClock clock(simulation.clock);
    station.loop.reset();
    station.loop = std::make_unique<ScanLoop>(device, clock);
    client->receive("MD0540054000000\n");
    EXPECT_TRUE(run_until(io, [&] {
        (void)systemd.meals();
        io.run_for(800ms);
        return !is_fed();
    }));
    EXPECT_FALSE(is_fed());

    station.loop.reset();
    station.loop = std::make_unique<ScanLoop>(device, simulation.clock);
    client->receive("MD0540054000000\n");
    for (int meal = 0; meal < 5; ++meal)
        EXPECT_TRUE(run_until(io, is_fed));
    service.stopping();
    client.reset();
    rig.stop();
}

}  // namespace
}  // namespace scipd::daemon
