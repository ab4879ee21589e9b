// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One fault of a scanner, from when it is asked for until nobody wants to know of it any more: its
// schedule, its effect while it acts, and what it has touched. Lives on its shard.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/common.h>

#include "daemon/faults/fault_effect.h"
#include "daemon/faults/fault_log.h"
#include "daemon/faults/fault_plan.h"
#include "daemon/faults/fault_schedule.h"

namespace scipd::daemon {

/// What the faults of a scanner share.
struct FaultSite {
    FaultSite(std::string name, std::vector<Port*> ports)
        : name(std::move(name)), ports(std::move(ports)) {}
    FaultSite(const FaultSite&) = delete;
    FaultSite& operator=(const FaultSite&) = delete;
    virtual ~FaultSite() = default;

    // As in FaultScene.
    [[nodiscard]] virtual Device& device() = 0;
    virtual void boot() = 0;
    /// Whether a driver asks for scans.
    [[nodiscard]] virtual bool driven() const = 0;

    std::string name;  ///< of the scanner, for the log
    std::vector<Port*> ports;
    FaultLog log;
    FaultMoment now;             ///< of what is looked at
    std::string request;         ///< the request that is looked at; empty: none
    std::uint64_t key = 0;       ///< of the chance of what is looked at
    protocol::Uptime stamped{};  ///< FaultScene::stamped()
};

class FaultRun final : private FaultScene {
  public:
    /// `site` must outlive it.
    FaultRun(FaultSite& site, std::uint64_t id, FaultPlan plan, std::uint64_t seed,
             std::optional<int> step);

    [[nodiscard]] std::uint64_t id() const { return id_; }
    [[nodiscard]] const FaultSchedule& schedule() const { return schedule_; }
    [[nodiscard]] FaultStatus status() const;

    /// Begins or ends, if that is due now.
    void advance();
    /// A request of this code is looked at: it may be what begins or ends the fault.
    void meet_request(std::string_view command);
    void meet_boot();
    /// It ends, and nobody wants to know of it any more.
    void stop();
    [[nodiscard]] bool stopped() const { return stopped_; }
    /// It acts, and a driver that may have lost its scanner by it waits for its end.
    [[nodiscard]] bool awaited() const { return acting_ && drove_; }

    /// Null: it does not act now.
    [[nodiscard]] FaultEffect* acting() { return acting_.get(); }
    [[nodiscard]] const FaultEffect* acting() const { return acting_.get(); }
    [[nodiscard]] FaultScene& scene() { return *this; }
    /// What may change messages: also an effect that has ended and still keeps some back.
    [[nodiscard]] FaultEffect* changing_messages() { return acting_ ? acting_.get() : last_.get(); }
    /// Whether it is ended and nothing of it is left.
    [[nodiscard]] bool gone() const;

    /// Lets effects do what they do at their begin and their end. Not from within a call of the
    /// device or of a port: clients may come and go in here. True: something has begun or ended.
    bool settle();
    [[nodiscard]] bool unsettled() const { return !changes_.empty(); }

  private:
    [[nodiscard]] Device& device() override { return site_.device(); }
    void boot() override { site_.boot(); }
    [[nodiscard]] std::span<Port* const> ports() override { return site_.ports; }
    [[nodiscard]] std::int64_t scan() const override { return site_.now.scan; }
    [[nodiscard]] double chance(std::uint32_t n) const override;
    [[nodiscard]] protocol::Uptime stamped() const override { return site_.stamped; }
    void touched(FaultTouch touch) override;

    void begin();
    void end();
    void log(spdlog::level::level_enum level, FaultTouch touch);

    struct Change {
        std::shared_ptr<FaultEffect> effect;
        bool begins;
    };

    FaultSite& site_;
    std::uint64_t id_;
    FaultPlan plan_;
    std::uint64_t seed_;
    std::optional<int> step_;
    FaultSchedule schedule_;
    std::shared_ptr<FaultEffect> acting_;
    std::shared_ptr<FaultEffect> last_;  ///< has ended, and keeps messages back
    std::vector<Change> changes_;        ///< that are not settled
    std::uint64_t hits_ = 0;
    bool stopped_ = false;
    bool drove_ = false;  ///< a driver was asking for scans when it began
};

}  // namespace scipd::daemon
