// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver and its scanner in stepped world time, so that minutes take moments: what it sends, what
// it receives and when, and, for whoever compares, the scan that was latest then.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <string>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/device/scan_loop.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {

class SteppedDriver {
  public:
    struct Received {
        sim::Time at;
        std::string bytes;
        sim::SharedScan scan;  ///< the latest one then
    };

    explicit SteppedDriver(const SensorConfig& config)
        : device_("robot", config, 1, world_, clock_) {}
    SteppedDriver(const SteppedDriver&) = delete;
    SteppedDriver& operator=(const SteppedDriver&) = delete;

    [[nodiscard]] sim::Time now() const { return clock_.now(); }
    [[nodiscard]] const protocol::DeviceProfile& profile() const { return device_.profile(); }

    void wait(sim::Time time) { clock_.advance_to(clock_.now() + time); }
    void wait_until(sim::Time time) { clock_.advance_to(time); }

    void send(const std::string& line) {
        client_->receive(line + "\n");
        collect();
    }

    /// The next message, which must be there or come some time.
    Received await() {
        while (received_.empty()) {
            wait(std::chrono::microseconds(100));
            collect();
        }
        Received first = received_.front();
        received_.pop_front();
        return first;
    }

    std::string ask(const std::string& line) {
        send(line);
        return await().bytes;
    }

  private:
    void collect() {
        while (const auto action = client_->session().next_action()) {
            if (const auto* message = std::get_if<protocol::Send>(&*action))
                received_.push_back({clock_.now(), message->bytes, device_.latest_scan()});
        }
        if (const auto at = client_->wake_at()) {
            alarm_->set(*at, [this] {
                client_->wake();
                collect();
            });
        }
    }

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_;
    ScanLoop loop_{device_, clock_};
    std::unique_ptr<Clock::Alarm> alarm_ = clock_.make_alarm();
    std::unique_ptr<Endpoint::Client> client_ =
        device_.connect([this] { collect(); }, protocol::LinkKind::network);
    std::deque<Received> received_;
};

}  // namespace scipd::daemon
