// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A source of live poses for one robot, as its configuration names it: UDP datagrams, standard
// input or a TUM file that is played in real time. Lives on the I/O thread.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/config.h"
#include "daemon/control/pose_intake.h"
#include "sim/time.h"

namespace scipd::daemon {

class PoseFeed {
  public:
    virtual ~PoseFeed() = default;
    /// Poses come from now on.
    virtual void start() = 0;
    virtual void stop() = 0;
};

/// What a feed needs of its surroundings; all must outlive it.
struct FeedContext {
    boost::asio::any_io_executor executor;
    PoseIntake& intake;
    std::function<sim::Time()> now;
    /// Tells a person that something was refused or is over.
    std::function<void(const std::string&)> report;
};

/// Opens the source. Throws std::runtime_error, or LoadError for a trajectory that cannot be read.
std::shared_ptr<PoseFeed> make_feed(const FeedContext& context, const std::string& robot,
                                    const PoseSource& source);

}  // namespace scipd::daemon
