// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/test_clock.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace scipd::testing {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

// Each time that it goes on by itself, or that somebody takes a scan.
constexpr auto patience = 30s;
// Between poses that are farther apart than a second, nothing moves.
constexpr std::int64_t step_us = 100'000;
constexpr auto wall_step = 20ms;

constexpr std::int64_t us_per_s = 1'000'000;

std::int64_t microseconds(TestClock::Seconds seconds) {
    return std::llround(std::max(seconds.count(), 0.0) * us_per_s);
}

}  // namespace

TestClock::TestClock(Running& running, const Options& options, CatchUp catch_up)
    : running_(running),
      catch_up_(std::move(catch_up)),
      leader_(Leader::wall),
      first_robot_(robot_pose_path(running.robots().front())) {
    if (options.clock == ClockKind::wall) return;
    const bool others = !options.poses.empty() || running.ready().contains("poses");
    resting_ = running.get(first_robot_);
    leader_ = others ? Leader::others : Leader::test;
}

double TestClock::now_s() {
    return running_.get(first_robot_).at("t");
}

void TestClock::run(Seconds seconds) {
    if (leader_ == Leader::wall) {
        std::this_thread::sleep_for(seconds);
    } else if (leader_ == Leader::others) {
        wait_until(now_s() + seconds.count());
    } else {
        move(first_robot_, seconds, [pose = resting_](double) { return pose; });
    }
}

void TestClock::move(const std::string& path, Seconds seconds,
                     const std::function<Json(double share)>& pose_at) {
    check_may_place();
    if (leader_ == Leader::wall) {
        const auto begin = steady_clock::now();
        for (Seconds gone{}; gone < seconds; gone = steady_clock::now() - begin) {
            running_.put(path, pose_at(gone / seconds));
            std::this_thread::sleep_for(std::min<Seconds>(wall_step, seconds - gone));
        }
        return running_.put(path, pose_at(1.0));
    }
    const std::int64_t begin_us = now_us_;
    const std::int64_t length_us = microseconds(seconds);
    while (now_us_ < begin_us + length_us) {
        now_us_ = std::min(now_us_ + step_us, begin_us + length_us);
        const double share = double(now_us_ - begin_us) / double(length_us);
        say(path, pose_at(share));
        settle();
    }
}

void TestClock::place(const std::string& path, const Json& pose) {
    check_may_place();
    if (leader_ == Leader::wall) return running_.put(path, pose);
    // From a pose to the next one a thing moves evenly, but not within a microsecond: that is a
    // jump.
    say(path, running_.get(path));
    say(path, pose);
    say(path, pose);
    settle();
}

void TestClock::say(const std::string& path, Json pose) {
    if (path == first_robot_) resting_ = pose;
    latest_us_ = std::max(now_us_, latest_us_ + 1);
    pose["t"] = double(latest_us_) / double(us_per_s);
    running_.put(path, pose);
}

/// A stamp takes effect with the next one, as others could move at the same stamp.
void TestClock::settle() {
    const std::int64_t stamp_us = latest_us_;
    say(first_robot_, resting_);
    wait_until(double(stamp_us) / double(us_per_s));
    catch_up_();
}

void TestClock::wait_until(double time_s) {
    constexpr double half_us = 5e-7;
    double latest_s = -1;
    auto pause = 0us;
    auto end = steady_clock::now() + patience;
    for (double at_s = now_s(); at_s < time_s - half_us; at_s = now_s()) {
        if (at_s != latest_s) {
            latest_s = at_s;
            pause = 200us;
            end = steady_clock::now() + patience;
        }
        if (steady_clock::now() > end) {
            throw TimeStandsStill("time has stood still at " + std::to_string(at_s) +
                                  " s for 30 s: a client does not read its scans, which holds time "
                                  "up, or poses of somebody else lead time");
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, std::chrono::microseconds(20ms));
    }
}

void TestClock::check_may_place() const {
    if (leader_ != Leader::others) return;
    throw ScipdError(
        "nothing can be put anywhere: in lockstep the source of the poses leads time, "
        "so it has to move things as well");
}

std::string robot_pose_path(const std::string& robot) {
    return "/robots/" + tools::path_segment(robot) + "/pose";
}

std::string model_pose_path(const std::string& model) {
    return "/scene/models/" + tools::path_segment(model) + "/pose";
}

}  // namespace scipd::testing
