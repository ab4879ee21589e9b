// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_stages.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <utility>
#include <variant>

#include "protocol/client/scan_request.h"
#include "protocol/subscription.h"
#include "sim/sensor/scanner.h"
#include "sim/world/pose_track.h"
#include "sim/world/poses_along.h"
#include "tools/scipbench/capacity_site.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// How long one call takes in processor time: others that run on this machine do not count.
double us_for_each(std::size_t count, const auto& work) {
    constexpr int rounds = 20;
    std::vector<double> us;
    for (int round = 0; round < rounds; ++round) {
        const double begin_s = thread_seconds();
        for (std::size_t i = 0; i < count; ++i)
            work(i);
        us.push_back(1e6 * (thread_seconds() - begin_s) / static_cast<double>(count));
    }
    return spread_of(std::move(us)).median;
}

class ScanStages {
  public:
    ScanStages(sim::RangeBackend& backend, const daemon::Model& model, bool driving,
               const std::vector<sim::Pose>& places)
        : backend_(backend),
          model_(model),
          scanner_(model.optics, {}),
          times_(driving ? beams() : 1) {
        const sim::Time turn = model.optics.scan_period;
        for (std::size_t i = 0; i < times_.size(); ++i)
            times_[i] = turn * static_cast<int>(i) / model.optics.steps_per_turn;
        for (const sim::Pose& place : places) {
            tracks_.emplace_back(on_its_lap(place, {}));
            for (sim::Time t = -pose_period; driving && t <= turn + pose_period; t += pose_period)
                tracks_.back().place(t, on_its_lap(place, t));
            scans_.push_back(scanner_.begin(0, {}, poses(scans_.size())));
        }
    }

    StageCosts measure() {
        const std::size_t count = tracks_.size();
        StageCosts costs{.rays = scanner_.directions().size()};
        costs.bare_cast_us = us_for_each(count, [this](std::size_t i) { cast_bare(i); });
        costs.poses_us = us_for_each(
            count, [this](std::size_t i) { scans_[i] = scanner_.begin(0, {}, poses(i)); });
        const sim::Beams all{0, beams()};
        costs.cast_us =
            us_for_each(count, [&](std::size_t i) { scanner_.cast(backend_, scans_[i], all, {}); });
        costs.errors_us =
            us_for_each(count, [this](std::size_t i) { scanner_.read(scans_[i], {}); });
        costs.encode_us = encode_us();
        return costs;
    }

  private:
    [[nodiscard]] std::size_t beams() const {
        return static_cast<std::size_t>(scanner_.spec().beams());
    }
    [[nodiscard]] std::vector<sim::Pose> poses(std::size_t i) const {
        return sim::poses_along(tracks_[i], robot_from_scanner_, times_);
    }

    void cast_bare(std::size_t i) {
        const sim::Pose& pose = scans_[i].world_from_sensor.front();
        backend_.cast({.directions = scanner_.directions(),
                       .world_from_sensor = {&pose, 1},
                       .max_range_m = static_cast<float>(model_.optics.max_range_m)},
                      scans_[i].hits);
    }

    [[nodiscard]] std::vector<std::uint32_t> millimetres(const sim::Scan& scan) const {
        std::vector<std::uint32_t> told;
        for (const sim::Reading& reading : scan.readings)
            told.push_back(reading.cause == sim::Cause::measured
                               ? static_cast<std::uint32_t>(std::lround(1e3 * reading.range_m))
                               : model_.profile.codes.nothing);
        return told;
    }

    [[nodiscard]] double encode_us() const {
        const protocol::DeviceProfile& profile = model_.profile;
        const std::string request =
            protocol::client::stream_line({.first_step = profile.amin, .last_step = profile.amax});
        auto stream = std::get<protocol::Subscription>(protocol::Subscription::from(
            protocol::parse_request({request}, profile), {}, profile.scan_period, profile));
        std::vector<std::vector<std::uint32_t>> told;
        for (const sim::Scan& scan : scans_)
            told.push_back(millimetres(scan));
        std::size_t bytes = 0;
        return us_for_each(told.size(), [&](std::size_t i) {
            bytes += stream.message({{}, profile.amin, told[i], told[i]}, {}, profile).size();
        });
    }

    sim::RangeBackend& backend_;
    const daemon::Model& model_;
    sim::Scanner scanner_;
    sim::Pose robot_from_scanner_ = sim::pose_from_rpy({0, 0, scanner_height_m}, {0, 0, 0});
    std::vector<sim::Time> times_;
    std::vector<sim::PoseTrack> tracks_;
    std::vector<sim::Scan> scans_;
};

}  // namespace

StageCosts measure_stages(sim::RangeBackend& backend, const daemon::Model& model, bool driving,
                          const std::vector<sim::Pose>& places) {
    return ScanStages(backend, model, driving, places).measure();
}

}  // namespace scipd::tools
