// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells all daemons of a world where something is. All poses of a tick leave in one message. Where
// things are now is kept by the broker, for those who come later. One thread: in a daemon the I/O
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/fleet/mqtt_link.h"
#include "daemon/fleet/topics.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/time.h"

namespace scipd::daemon {

class PoseSender {
  public:
    /// All must outlive it. `name` is what the others call this sender.
    PoseSender(const boost::asio::any_io_executor& executor, MqttLink& link, const Topics& topics,
               std::string name);

    /// The line names a robot or a model. Its time, if it has one, is that of this sender's clock.
    void send(const sim::PoseLine& line);
    /// For those who come later; all others know it already.
    void keep(const sim::PoseLine& line);
    /// From now on somebody else moves it.
    void forget(const std::string& model);
    /// Says where all stands now, to a broker that may not know it.
    void say_all(std::optional<sim::Time> now);
    /// Whether nothing waits to be sent.
    [[nodiscard]] bool idle() const { return !awake_; }

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  private:
    void wake();
    void tick();
    void send_frame();
    void keep_places();

    MqttLink& link_;
    const Topics& topics_;
    const std::string name_;
    boost::asio::steady_timer timer_;
    bool awake_ = false;
    std::string frame_;
    /// As they are kept: their times are since 1970. By kind and name.
    std::map<std::pair<bool, std::string>, sim::PoseLine> places_;
    bool places_changed_ = false;
    std::chrono::steady_clock::time_point places_kept_{};
    std::uint64_t dropped_ = 0;  ///< frames that the broker was too slow for
};

}  // namespace scipd::daemon
