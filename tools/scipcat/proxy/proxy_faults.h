// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults on purpose at a real scanner: begins and ends each when it is due, and lets those that act
// change what is said. Scans count as they pass, from 1, and time from when this is made. One
// thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/faults/fault_plan.h"
#include "daemon/faults/fault_run.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/port.h"
#include "protocol/action.h"
#include "protocol/request.h"
#include "protocol/speaker.h"
#include "protocol/status.h"

namespace scipd::tools {

/// KIND[,MEMBER=VALUE...] as a fault; a value is YAML, and dots nest: "cut,how=fin,for.s=2". Throws
/// WrongInput.
[[nodiscard]] daemon::FaultPlan fault_in_words(const std::string& words);

class ProxyFaults final : private daemon::LineHook {
  public:
    /// All outlive it. The port serves the relay already.
    ProxyFaults(const std::vector<daemon::FaultPlan>& plans, const std::string& scanner,
                daemon::Port& port, daemon::Clock& clock);
    ProxyFaults(const ProxyFaults&) = delete;
    ProxyFaults& operator=(const ProxyFaults&) = delete;
    ~ProxyFaults() override;

    /// Whether one acts, or may yet.
    [[nodiscard]] bool any() const;
    /// A status: the scanner never gets the request, and the driver gets this.
    [[nodiscard]] std::optional<protocol::Status> refuse(const protocol::Request& request);
    /// These leave in the place of the message, in order.
    [[nodiscard]] std::vector<protocol::Send> leave(const protocol::Speaker& from,
                                                    protocol::Send message);
    /// The driver is another one from here on, or there is none.
    void forget(const protocol::Speaker& from);

  private:
    class Site;

    // LineHook
    /// What leaves has been changed already: it may have waited for a driver that reads slowly.
    void leaving(protocol::Send& /*message*/) override {}
    void connected(daemon::Port& port) override;

    void look_at(bool serving);
    void look_at(const protocol::Send& message, std::uint64_t& replies);
    void change_bytes(protocol::Send& message);
    void advance();
    /// Does what has begun or ended; not from within a call of the port.
    void settle();
    void settle_soon();
    void compose();
    void wait();

    daemon::Port& port_;
    daemon::Clock& clock_;
    std::unique_ptr<Site> site_;
    std::vector<std::unique_ptr<daemon::FaultRun>> runs_;
    std::int64_t scan_ = 0;  ///< how many have passed
    std::string asked_;      ///< the code of the latest request
    std::uint64_t replies_ = 0;
    std::uint64_t replies_sent_ = 0;
    daemon::LineState line_;
    std::unique_ptr<daemon::Clock::Alarm> alarm_;
    std::unique_ptr<daemon::Clock::Alarm> soon_;
};

}  // namespace scipd::tools
