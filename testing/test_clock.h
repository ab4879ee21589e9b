// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What time is for a test, and how it goes on: by itself on the wall clock, or in lockstep by
// stamps that come from here, or from somebody else. Poses are set here too, since in lockstep they
// are the stamps. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "testing/running.h"

namespace scipd::testing {

class TestClock {
  public:
    using Seconds = std::chrono::duration<double>;

    /// Waits for all threads that hear scipd: in lockstep, time waits until they have caught up.
    using CatchUp = std::function<void()>;

    TestClock(Running& running, const Options& options, CatchUp catch_up);

    /// Whether run() makes time go on, rather than wait for it.
    [[nodiscard]] bool leads() const { return leader_ == Leader::test; }
    /// Since the start of scipd, or in lockstep the stamp.
    [[nodiscard]] double now_s();
    /// Returns when so much time has passed. Throws TimeStandsStill.
    void run(Seconds seconds);
    /// Puts a robot or a model there at once; `path` is that of its pose.
    void place(const std::string& path, const Json& pose);
    /// Has a robot or a model move, for so long. `pose_at` gets the share of the way from 0 to 1.
    void move(const std::string& path, Seconds seconds,
              const std::function<Json(double share)>& pose_at);

  private:
    enum class Leader { wall, test, others };

    void say(const std::string& path, Json pose);
    void settle();
    void wait_until(double time_s);
    void check_may_place() const;

    Running& running_;
    CatchUp catch_up_;
    Leader leader_;
    std::string first_robot_;  ///< the path of its pose
    Json resting_;             ///< where that was last put: it stays there while others move
    std::int64_t now_us_ = 0;
    std::int64_t latest_us_ = -1;  ///< the latest stamp that was sent
};

/// The path of a pose in the control API.
[[nodiscard]] std::string robot_pose_path(const std::string& robot);
[[nodiscard]] std::string model_pose_path(const std::string& model);

}  // namespace scipd::testing
