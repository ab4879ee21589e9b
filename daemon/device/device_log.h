// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Logs what changes at one scanner: clients come, wait and leave, it boots, its laser is switched
// on or off. More than 20 changes a second are suppressed, and counted once they calm down. Lives
// on the shard of the scanner.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "daemon/clock/clock.h"
#include "daemon/limits/throttle.h"
#include "daemon/link/client_watch.h"

namespace scipd::daemon {

class DeviceLog : public ClientWatch {
  public:
    enum class By { tcp_client, tty_client, fault, leaving_client, last_scan };

    /// `name` is what the log calls the scanner. The clock must outlive this.
    DeviceLog(std::string name, Clock& clock) : name_(std::move(name)), clock_(clock) {}
    DeviceLog(const DeviceLog&) = delete;
    DeviceLog& operator=(const DeviceLog&) = delete;
    ~DeviceLog() override;

    /// See Device::count_clients_in().
    void count_in(std::atomic<int>& clients) { clients_ = &clients; }

    /// It was so before anybody could ask.
    void know(bool laser_on) { laser_on_ = laser_on; }
    void booted(bool laser_on);
    /// To be called whenever the laser may have been switched.
    void laser(bool on, By by);

    // ClientWatch
    void came(const std::string& from) override;
    void waits(const std::string& from, const std::string& served) override;
    void left(protocol::LinkKind from, Leaving why) override;

  private:
    void count(int more);
    void log(const std::string& change);
    void log_suppressed();

    std::string name_;
    Clock& clock_;
    std::atomic<int>* clients_ = nullptr;
    int connected_ = 0;
    std::unique_ptr<Clock::Alarm> calm_;  ///< null: nothing has been suppressed yet
    Throttle throttle_{20};
    std::string latest_suppressed_;
    bool laser_on_ = false;
};

}  // namespace scipd::daemon
