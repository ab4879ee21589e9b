// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A running scipd as a service of systemd. It tells systemd what it does, in words for people, and
// feeds the watchdog as long as every scan loop gets on: systemd starts it again where one is
// stuck, or the whole thread is. Where systemd asks for none of this, nothing happens. It does not
// know what runs: it is told. Lives on the I/O thread.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/device/scan_watch.h"

namespace scipd::daemon {

/// What runs, as systemd sees it. Called on the I/O thread.
struct Served {
    std::function<std::string()> status;  ///< in a line, for people
    std::function<std::vector<ScanWatch::Look>()> loops;
};

class Service {
  public:
    Service(const boost::asio::any_io_executor& executor, Served served);

    /// Everything listens.
    void ready();
    void reloading(const std::string& file);
    /// `fault`: why nothing was changed.
    void reloaded(const std::string& fault = {});
    void stopping();

  private:
    [[nodiscard]] std::string status() const;
    /// Looks after everything now and then, from here on.
    void go_on();
    void tell_changes();
    void feed();

    const Served served_;
    std::chrono::nanoseconds pause_;  ///< between two looks
    std::optional<ScanWatch> watch_;  ///< nothing: there is no watchdog
    boost::asio::steady_timer timer_;
    std::string told_;   ///< of status()
    std::string fault_;  ///< of the last reload
    bool reloading_ = false;
    bool stopping_ = false;
    std::vector<std::string> stuck_;
};

}  // namespace scipd::daemon
