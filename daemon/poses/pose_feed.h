// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A source of live poses for one robot, as its configuration names it: UDP datagrams, standard
// input, the bus of another program, or a trajectory that is played. In lockstep it reads on when
// what has come has been worked off. Lives on the I/O thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/clock/clock.h"
#include "daemon/config/config.h"
#include "daemon/poses/arrivals.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/poses/read_trajectory.h"
#include "daemon/poses/source_report.h"

namespace scipd::daemon {

class Bus;
class BusListener;
class HeardMeaning;

class PoseFeed {
  public:
    virtual ~PoseFeed() = default;

    /// Poses come from now on, for this robot; called again, for another one.
    void serve(const std::string& robot, const PoseNeeds& needs = {}) {
        robot_ = robot;
        needs_ = needs;
        if (!std::exchange(begun_, true)) begin();
    }
    virtual void stop() = 0;
    /// Where poses are to be sent, with the port that was really taken; nothing: not by a network.
    [[nodiscard]] virtual std::optional<Address> address() const { return std::nullopt; }
    /// Tells this feed whether to move models. Of several feeds with one source, one does.
    virtual void move_models(bool /*yes*/) {}
    /// What has come.
    [[nodiscard]] virtual SourceReport report() const = 0;

  protected:
    [[nodiscard]] const std::string& robot() const { return robot_; }
    [[nodiscard]] const PoseNeeds& needs() const { return needs_; }

  private:
    virtual void begin() = 0;

    std::string robot_;
    PoseNeeds needs_;
    bool begun_ = false;
};

/// What a feed needs of its surroundings; all must outlive it.
struct FeedContext {
    boost::asio::any_io_executor executor;
    PoseIntake& intake;
    Clock& clock;
    Lockstep* lockstep = nullptr;  ///< null: on the wall clock
    /// Tells a person that something was refused or is over.
    std::function<void(const std::string&)> report;
};

/// A trajectory, which read_trajectory() has read from the source.
std::shared_ptr<PoseFeed> make_trajectory_feed(const FeedContext& context, const PoseSource& source,
                                               PlayedPoses poses);

/// The bus that the source names. Throws std::runtime_error where it cannot be listened to.
std::shared_ptr<PoseFeed> make_bus_feed(const FeedContext& context, const PoseSource& source);
/// Any bus.
using OpenBus = std::function<std::unique_ptr<Bus>(BusListener& listener)>;
std::shared_ptr<PoseFeed> make_bus_feed(const FeedContext& context, const PoseSource& source,
                                        std::unique_ptr<HeardMeaning> meaning, const OpenBus& open);

/// Opens the source. `poses` are those of a trajectory. Throws std::runtime_error.
std::shared_ptr<PoseFeed> make_feed(const FeedContext& context, const PoseSource& source,
                                    PlayedPoses poses = nullptr);

}  // namespace scipd::daemon
