// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All robots and scanners of a configuration, with their ports and pose feeds, in one simulation. A
// new configuration is applied as a whole or not at all, in three steps: all that takes long is in
// its plan (rig_plan.h), which may fail; then what leaves ends while its world stands; then the new
// takes its place and starts. The last two are quick and cannot fail; shards stand still for them.
// Scanners that did not change keep their connections and their scan numbers. Start and end are the
// same with nothing before, or after. Lives on the I/O thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/config/address.h"
#include "daemon/faults/scenario.h"
#include "daemon/plan/homes.h"
#include "daemon/plan/known_sensors.h"
#include "daemon/plan/load_tapes.h"
#include "daemon/rig/ports.h"

namespace scipd::daemon {

enum class ClockKind;
struct RigPlan;
struct Running;
struct Simulation;
struct Station;

class Rig {
  public:
    /// `handed`, sockets for its scanners, must outlive it; null: none. Its sensors live on
    /// `shards` threads.
    Rig(const boost::asio::any_io_executor& executor, ClockKind clock,
        const HandedSockets* handed = nullptr, std::size_t shards = 1);
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;
    /// As stop().
    ~Rig();

    /// Throws std::runtime_error for a port or a source of poses: then all is as before. The plan
    /// was made for what is running(). Returns how long all sensors stood still for it.
    std::chrono::nanoseconds apply(RigPlan&& plan);
    /// Applies a configuration whose world is still to be loaded, and throws what make_plan()
    /// throws.
    void apply(const Config& config);
    void stop();

    [[nodiscard]] Simulation& simulation() { return *simulation_; }
    /// What a plan need not find out again.
    [[nodiscard]] Running running() const;
    /// Where poses by UDP are to be sent, by robot.
    [[nodiscard]] std::map<std::string, Address> pose_addresses() const;

  private:
    struct Feed;
    using Feeds = std::vector<Feed>;

    /// With all that it takes to serve those scanners that will be new.
    [[nodiscard]] Ports prepare_ports(const Config& config, const Homes& homes) const;
    [[nodiscard]] Feeds open_feeds(const RigPlan& plan);
    /// The second half of apply(), in which nothing can fail.
    void take_up(RigPlan&& plan, Ports ports, Feeds feeds) noexcept;
    /// What this configuration has not goes: first, so that its world still stands.
    void retire(const Config& config, const Ports& ports) noexcept;
    void replace_world(RigPlan& plan) noexcept;
    /// As the configuration has it, in the place of what people have made of it.
    void begin_world(RigPlan& plan) noexcept;
    /// Returns those that are new.
    std::vector<Station*> start(const RigPlan& plan, const Ports& ports) noexcept;
    /// One that is the same goes on, also for new scanners.
    void replace_scenario(RigPlan& plan, const std::vector<Station*>& fresh) noexcept;
    void replace_feeds(Feeds feeds) noexcept;

    boost::asio::any_io_executor executor_;
    const HandedSockets* handed_;
    std::unique_ptr<Simulation> simulation_;
    Homes homes_;
    Ports ports_;
    Feeds feeds_;
    std::optional<Scenario> scenario_;  ///< of the configuration
};

}  // namespace scipd::daemon
