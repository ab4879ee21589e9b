// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A trajectory as a feed. On the wall clock it hands poses on a little before their time, so that
// every sweep lies between two known poses. In lockstep it hands them on one after the other, while
// somebody waits for time to go on.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "daemon/poses/pose_feed.h"
#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

class TrajectoryFeed : public PoseFeed, public std::enable_shared_from_this<TrajectoryFeed> {
  public:
    TrajectoryFeed(const FeedContext& context, const PoseSource& source, PlayedPoses poses)
        : context_(context),
          shared_(std::move(poses)),
          poses_(*shared_),
          source_(source),
          speed_(source.speed),
          loop_(source.loop),
          alarm_(context.clock.make_alarm()) {}
    ~TrajectoryFeed() override { stop(); }

    void stop() override {
        alarm_->cancel();
        next_ = poses_.size();
        if (context_.lockstep != nullptr) context_.lockstep->remove(this);
    }

    [[nodiscard]] SourceReport report() const override {
        SourceReport report{.robot = robot(), .source = text_of(source_)};
        report.messages = handed_on_;
        return report;
    }

  private:
    // It goes on so often, and hands on what lies within three times that: so all is known of a
    // movement of which a pose has come, and whose poses are a second apart at most.
    static constexpr sim::Time ahead = std::chrono::milliseconds(500);

    // Feeds that begin together go on at so many moments of that time, each by the name of its
    // robot. If hundreds of them went on at once, all sweeps would wait for milliseconds.
    static constexpr int moments = 25;

    // Poses may lie close together or be played fast, so the sweeps get their turn in between.
    static constexpr int poses_in_one_go = 256;

    void begin() override {
        lap_begin_ = context_.clock.now();
        wait_ = ahead * static_cast<int>(sim::fnv1a<std::uint64_t>(robot()) % moments) / moments;
        if (context_.lockstep == nullptr) return play();
        context_.lockstep->add(this);
        step();
    }

    void play() {
        const sim::Time now = context_.clock.now();
        const auto due = [&] { return next_ < poses_.size() && next_time() <= now + 3 * ahead; };
        for (int i = 0; i < poses_in_one_go && due(); ++i)
            hand_on();
        if (next_ == poses_.size()) return;
        alarm_->set(due() ? now : now + std::exchange(wait_, ahead), [this] { play(); });
    }

    void step() {
        if (next_ >= poses_.size()) return context_.lockstep->remove(this);
        const sim::Time time = next_time();
        hand_on();
        context_.lockstep->come_to(this, time, true);
        context_.lockstep->when_awaited([weak = weak_from_this()] {
            if (const auto feed = weak.lock()) feed->step();
        });
    }

    /// World time of the next pose.
    [[nodiscard]] sim::Time next_time() const {
        return lap_begin_ + scaled(poses_[next_].time - poses_.front().time);
    }

    [[nodiscard]] sim::Time scaled(sim::Time of_file) const {
        const double nanoseconds = static_cast<double>(of_file.count()) / speed_;
        return sim::Time(std::llround(nanoseconds));
    }

    void hand_on() {
        const sim::TimedPose& pose = poses_[next_];
        (void)context_.intake.take_at(next_time(), {.time = pose.time, .pose = pose.pose}, robot());
        ++next_;
        ++handed_on_;
        if (next_ == poses_.size() && loop_ && poses_.size() > 1) begin_lap();
    }

    void begin_lap() {
        lap_begin_ += scaled(lap_time(poses_));
        next_ = 0;
    }

    FeedContext context_;
    PlayedPoses shared_;
    const std::vector<sim::TimedPose>& poses_;  ///< *shared_
    PoseSource source_;
    std::uint64_t handed_on_ = 0;
    double speed_;
    bool loop_;
    std::unique_ptr<Clock::Alarm> alarm_;
    sim::Time lap_begin_{};  ///< world time of the first pose
    sim::Time wait_{};       ///< until it goes on the next time
    std::size_t next_ = 0;
};

}  // namespace

std::shared_ptr<PoseFeed> make_trajectory_feed(const FeedContext& context, const PoseSource& source,
                                               PlayedPoses poses) {
    return std::make_shared<TrajectoryFeed>(context, source, std::move(poses));
}

}  // namespace scipd::daemon
