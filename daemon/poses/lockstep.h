// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// In lockstep, the stamps of the poses are the time. It goes on to the stamp that every stream of
// poses has reached, and no farther. Whatever is due on the way is done in the order of time. The
// daemon neither sleeps nor skips: it goes as fast as the poses come and the clients read. Lives on
// the I/O thread.
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

    /// World time of a stamp. The first stamp of all is 0, and all streams share that origin.
    /// Nothing where the stamp is too far from it.
    [[nodiscard]] std::optional<sim::Time> world_time(sim::Time stamp) const;
    /// A pose with this stamp was taken. If it is the first of all, it becomes the clock's origin.
    void begin_with(sim::Time stamp);
    /// The world time that a stamp would have if this stream went on with `first` from where it is.
    [[nodiscard]] std::optional<sim::Time> time_anew(Stream stream, sim::Time first,
                                                     sim::Time stamp) const;
    /// Lets the stream go on so, for all streams. World time goes on without a leap, and the
    /// clock's origin leaps instead.
    void begin_anew_with(Stream stream, sim::Time first);

    /// From now on time waits for this stream.
    void add(Stream stream) { streams_.try_emplace(stream); }
    /// The stream has ended, and time no longer waits for it.
    void remove(Stream stream);
    /// The stream has reached this time. Unless it has `said_all` of that time, more may follow,
    /// such as another robot's pose; time then goes on to it only when the stream has come farther.
    /// A stream that was not added leads time only where none was added.
    void come_to(Stream stream, sim::Time time, bool said_all);
    /// The latest time that the stream has reached, and not less than the present time.
    [[nodiscard]] sim::Time come_to(Stream stream) const;
    /// Whether the stream leads time, alone or with others.
    [[nodiscard]] bool leads(Stream stream) const {
        return streams_.empty() || streams_.contains(stream);
    }

    /// Calls back once everything is done that is due up to the poses that have come.
    void when_caught_up(Call call);
    /// Calls back when all that is done and somebody waits for time to go on.
    void when_awaited(Call call);

  private:
    struct Progress {
        std::optional<sim::Time> latest;  ///< stamp
        std::optional<sim::Time> known;   ///< nothing more will be said up to this stamp
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
    Progress others_;  ///< of all streams that were not added, together
    std::vector<Call> for_caught_up_;
    std::vector<Call> for_awaited_;
    bool at_work_ = false;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace scipd::daemon
