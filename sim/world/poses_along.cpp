// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/poses_along.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include <glm/geometric.hpp>

#include "sim/recycled.h"

namespace scipd::sim {
namespace {

using Seconds = std::chrono::duration<double>;

/// The farthest half angle that sine_of() and cosine_of() are asked for.
constexpr double farthest_rad = 0.1;

// The first terms of the series: within farthest_rad they are off by less than 2e-11. A call of
// the library for each beam would take as long as all the rest.
double sine_of(double x) {
    const double y = x * x;
    return x * (1.0 + y * (-1.0 / 6 + y * (1.0 / 120)));
}

double cosine_of(double x) {
    const double y = x * x;
    return 1.0 + y * (-1.0 / 2 + y * (1.0 / 24 + y * (-1.0 / 720)));
}

/// The mount while the thing moves evenly, from `now` on. It turns by an angle a about an axis k: a
/// vector r becomes the part along k, and what remains times cos a, and k x r times sin a. The
/// rotation itself is that of `now` times cos a/2, and k times that one times sin a/2.
class EvenMotion {
  public:
    EvenMotion(const PoseTrack::Stretch& stretch, const Pose& thing_from_mount, Time now)
        : begin_(now), end_(stretch.end), velocity_mps_(stretch.velocity.linear_mps) {
        const Pose here = moved(stretch.from, stretch.velocity, seconds(now - stretch.begin));
        const double speed_radps = glm::length(stretch.velocity.angular_radps);
        half_radps_ = speed_radps / 2.0;
        const glm::dvec3 axis =
            speed_radps > 0.0 ? stretch.velocity.angular_radps / speed_radps : glm::dvec3{0.0};
        const glm::dvec3 arm_m = here.rotation * thing_from_mount.translation_m;
        const glm::dvec3 along_m = axis * glm::dot(axis, arm_m);
        centre_m_ = here.translation_m + along_m;
        with_cosine_m_ = arm_m - along_m;
        with_sine_m_ = glm::cross(axis, arm_m);
        of_cosine_ = here.rotation * thing_from_mount.rotation;
        of_sine_ = glm::dquat{0.0, axis.x, axis.y, axis.z} * of_cosine_;
        // A jump takes a nanosecond, at any speed.
        end_ = std::clamp(later(now, farthest_rad / half_radps_), now + Time(1), end_);
    }

    /// It holds until then.
    [[nodiscard]] Time end() const { return end_; }

    /// At each of these times, for which it holds.
    void place(std::span<const Time> times, std::span<Pose> poses) const {
        // In short runs and two loops, which compilers turn into vectors.
        constexpr std::size_t run = 32;
        std::array<double, run> since_s;
        std::array<double, run> sine;
        std::array<double, run> cosine;
        for (std::size_t first = 0; first < times.size(); first += run) {
            const std::size_t count = std::min(run, times.size() - first);
            for (std::size_t i = 0; i < count; ++i)
                since_s[i] = seconds(times[first + i] - begin_);
            for (std::size_t i = 0; i < count; ++i) {
                sine[i] = sine_of(half_radps_ * since_s[i]);
                cosine[i] = cosine_of(half_radps_ * since_s[i]);
            }
            for (std::size_t i = 0; i < count; ++i)
                poses[first + i] = turned(since_s[i], sine[i], cosine[i]);
        }
    }

  private:
    [[nodiscard]] Pose turned(double since_s, double sine, double cosine) const {
        return {centre_m_ + velocity_mps_ * since_s + with_cosine_m_ * (1.0 - 2.0 * sine * sine) +
                    with_sine_m_ * (2.0 * sine * cosine),
                of_cosine_ * cosine + of_sine_ * sine};
    }

    static double seconds(Time time) { return Seconds(time).count(); }
    /// At the latest when Time ends; `after_s` may be infinite.
    static Time later(Time time, double after_s) {
        constexpr double long_s = 1e6;
        return time + std::chrono::duration_cast<Time>(Seconds(std::min(after_s, long_s)));
    }

    Time begin_;
    Time end_;
    glm::dvec3 velocity_mps_;
    glm::dvec3 centre_m_{0.0};
    glm::dvec3 with_cosine_m_{0.0};
    glm::dvec3 with_sine_m_{0.0};
    double half_radps_ = 0.0;
    glm::dquat of_cosine_{1.0, 0.0, 0.0, 0.0};
    glm::dquat of_sine_{0.0, 0.0, 0.0, 0.0};
};

}  // namespace

std::vector<Pose> poses_along(const PoseTrack& track, const Pose& thing_from_mount,
                              std::span<const Time> times) {
    std::vector<Pose> poses = Recycled<Pose>::take(times.size());
    for (std::size_t first = 0; first < times.size();) {
        const auto until = [&](Time end) {
            const auto behind = std::ranges::lower_bound(times.subspan(first), end);
            const auto count = static_cast<std::size_t>(behind - times.begin()) - first;
            return std::span(poses).subspan(first, count);
        };
        const PoseTrack::Stretch stretch = track.stretch(times[first]);
        std::span<Pose> there;
        if (stretch.velocity == Velocity{}) {
            // Equal to the last bit, however often it is asked for.
            there = until(stretch.end);
            std::ranges::fill(there, stretch.from * thing_from_mount);
        } else {
            const EvenMotion motion(stretch, thing_from_mount, times[first]);
            there = until(motion.end());
            motion.place(times.subspan(first, there.size()), there);
        }
        first += there.size();
    }
    return poses;
}

}  // namespace scipd::sim
