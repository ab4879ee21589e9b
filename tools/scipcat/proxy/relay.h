// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A real scanner as the far end of a link: what a driver says goes to it, and what it says goes to
// the driver, byte for byte and at once. The scanner is connected to as long as a driver is there.
// While faults may act, lines and messages are put together first, for that is what faults know.
// One thread.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/link/endpoint.h"
#include "tools/scip_transport.h"
#include "tools/target.h"

namespace scipd::tools {

class ProxyFaults;

class Relay final : public daemon::Endpoint {
  public:
    struct Hooks {
        /// What has gone to the scanner, or come from it, just now. It has been handed on already.
        std::function<void(bool to_scanner, std::string_view bytes)> heard;
        std::function<void()> opened;
        /// The scanner goes on at this rate, and its tty too, or cannot.
        std::function<void(int bits_per_second, bool set)> rate;
        /// The scanner is gone, or was not there: who is connected is to be cut off.
        std::function<void(const std::string& why)> lost;
    };

    Relay(boost::asio::any_io_executor executor, Target target, OpenOptions options,
          daemon::Clock& clock, Hooks hooks);

    /// They outlive it; null: there are none.
    void set_faults(ProxyFaults* faults) { faults_ = faults; }
    /// A driver is there: connects it to the scanner.
    void open();

    [[nodiscard]] std::unique_ptr<Client> connect(std::function<void()> on_actions,
                                                  protocol::LinkKind link) override;
    [[nodiscard]] daemon::Clock& clock() override { return clock_; }
    [[nodiscard]] sim::ChanceKey chance(sim::Purpose purpose) const override {
        return {.purpose = purpose};
    }

  private:
    class Driver;

    boost::asio::any_io_executor executor_;
    Target target_;
    OpenOptions options_;
    daemon::Clock& clock_;
    Hooks hooks_;
    ProxyFaults* faults_ = nullptr;
    Driver* driver_ = nullptr;  ///< the one that is served; it says itself when it comes and goes
};

}  // namespace scipd::tools
