// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Time that is the stamps of the poses: it goes on as far as every stream has come, and no farther,
// and what was due on the way is done in the order of time. The daemon neither sleeps nor skips: it
// goes as fast as the poses come and the clients read. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/clock/stepped_clock.h"
#include "sim/time.h"

namespace scipd::daemon {

class Lockstep {
  public:
    /// Whoever sends poses: a feed, for instance.
    using Stream = const void*;
    using Call = std::function<void()>;

    explicit Lockstep(boost::asio::any_io_executor executor);
    Lockstep(const Lockstep&) = delete;
    Lockstep& operator=(const Lockstep&) = delete;

    [[nodiscard]] SteppedClock& clock() { return clock_; }

    /// World time of a stamp: the first one of all is 0, and streams share their time. Nothing
    /// where it is too far from that.
    [[nodiscard]] std::optional<sim::Time> world_time(sim::Time stamp) const;
    /// A pose of this stamp holds: if it is the first of all, the clock's origin.
    void begin_with(sim::Time stamp);
    /// World time of a stamp if time went on with `first` from how far this stream has come.
    [[nodiscard]] std::optional<sim::Time> time_anew(Stream stream, sim::Time first,
                                                     sim::Time stamp) const;
    /// So it does, for all streams. World time goes on; what people call it, its origin, leaps.
    void begin_anew_with(Stream stream, sim::Time first);

    /// Time does not go on before this one has said so.
    void add(Stream stream) { streams_.try_emplace(stream); }
    /// It has said all, and holds nobody back any more.
    void remove(Stream stream);
    /// It has come to this time; where it has not said all of that time (another robot's pose, say)
    /// time goes on to it when the stream has come farther. Streams that were not added lead where
    /// there is no other.
    void come_to(Stream stream, sim::Time time, bool said_all);
    /// The latest that it has come to, or what time it is.
    [[nodiscard]] sim::Time come_to(Stream stream) const;
    /// It leads time, alone or with others.
    [[nodiscard]] bool leads(Stream stream) const {
        return streams_.empty() || streams_.contains(stream);
    }

    /// Calls once everything that is due by the poses that have come has been done.
    void when_caught_up(Call call);
    /// The same, but not before somebody waits for something.
    void when_awaited(Call call);

  private:
    struct Progress {
        std::optional<sim::Time> latest;  ///< stamp
        std::optional<sim::Time> known;   ///< all is known until then
    };

    [[nodiscard]] const Progress& progress(Stream stream) const;
    [[nodiscard]] sim::Time target() const;
    [[nodiscard]] sim::Time origin_with(sim::Time stamp) const;
    void call_whoever_waits();
    void go_on();
    void work();

    boost::asio::any_io_executor executor_;
    SteppedClock clock_;
    bool begun_ = false;  ///< the clock has its origin
    std::map<Stream, Progress> streams_;
    Progress others_;
    std::vector<Call> for_caught_up_;
    std::vector<Call> for_awaited_;
    bool at_work_ = false;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace scipd::daemon
