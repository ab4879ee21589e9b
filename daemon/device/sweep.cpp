// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/sweep.h"

#include <algorithm>
#include <utility>

#include "sim/sensor/encounters.h"

namespace scipd::daemon {
namespace {

/// The beams of part `i` of `count` equal ones. The pixels of a picture squared are more than an
/// int holds.
sim::Beams part_of(std::size_t beams, std::size_t i, std::size_t count) {
    const std::size_t first = i * beams / count;
    return {first, (i + 1) * beams / count - first};
}

/// The step in the middle of some beams.
int middle(const sim::SensorSpec& optics, const sim::Beams& beams) {
    return optics.first_step + static_cast<int>(beams.first + beams.count / 2);
}

}  // namespace

Sweep::Sweep(World& world, std::string robot, const SensorConfig& config, sim::Scanner scanner)
    : world_(world),
      robot_(std::move(robot)),
      name_(robot_ + "/" + config.name),
      robot_from_sensor_(config.robot_from_sensor),
      motion_(config.motion),
      sees_body_(config.sees_body),
      scanner_(std::move(scanner)) {}

sim::SharedScan Sweep::measure(std::int64_t revolution, sim::Time start, const Fired& fired) const {
    std::vector<sim::Time> times = pose_times(fired);
    sim::Scan scan = scanner_.begin(revolution, start, poses_at(times));
    scan.posed_at = std::move(times);
    cast(scan, fired);
    scanner_.read(scan);
    return std::make_shared<const sim::Scan>(std::move(scan));
}

std::vector<sim::Pose> Sweep::poses_at(const std::vector<sim::Time>& times) const {
    const sim::PoseTrack& track = *world_.robot(robot_);
    std::vector<sim::Pose> poses;
    poses.reserve(times.size());
    for (const sim::Time time : times) {
        const bool same = !poses.empty() && time == times[poses.size() - 1];
        poses.push_back(same ? poses.back() : track.at(time) * robot_from_sensor_);
    }
    return poses;
}

void Sweep::cast(sim::Scan& scan, const Fired& fired) const {
    const sim::ModelId unseen = sees_body_ ? sim::no_model : world_.body_of(robot_);
    const sim::PoseTrack& track = *world_.robot(robot_);
    const bool absent = track.absent(fired(optics().first_step));
    const bool comes_or_goes = absent != track.absent(fired(optics().last_step));
    if (motion_ || comes_or_goes) return cast_in_equal_parts(scan, fired, unseen);
    if (absent) return;
    const std::vector<sim::Mover> movers = world_.movers(unseen);
    sim::RangeBackend& backend = world_.backend(name_);
    const auto beam_fired = [&](std::size_t beam) {
        return fired(optics().first_step + static_cast<int>(beam));
    };
    for (const sim::Part& part :
         sim::parts_of_sweep(optics(), scan.world_from_sensor, beam_fired, movers)) {
        for (const sim::Put& put : part.puts)
            backend.move(movers[put.mover].id, movers[put.mover].path->at(put.time));
        scanner_.cast(backend, scan, part.beams, unseen, part.can_meet);
    }
}

void Sweep::cast_in_equal_parts(sim::Scan& scan, const Fired& fired, sim::ModelId unseen) const {
    for (const Part& part : parts(fired))
        scanner_.cast(world_.backend_at(name_, part.time), scan, part.beams, unseen);
}

int Sweep::most_parts() const {
    return std::clamp(motion_.value_or(optics().beams()), 1, optics().beams());
}

std::vector<sim::Time> Sweep::pose_times(const Fired& fired) const {
    const int beams = optics().beams();
    const sim::Time begin = fired(optics().first_step);
    const sim::Time end = fired(optics().last_step);
    if (begin == end || world_.robot(robot_)->still(begin, end)) return {begin};
    const int count = most_parts();
    std::vector<sim::Time> times;
    times.reserve(static_cast<std::size_t>(beams));
    for (int i = 0; i < count; ++i) {
        const sim::Beams shared = part_of(beams, i, count);
        times.resize(shared.first + shared.count, fired(middle(optics(), shared)));
    }
    return times;
}

// A part without a pose of the sensor is not cast: it is nowhere then.
std::vector<Sweep::Part> Sweep::parts(const Fired& fired) const {
    const int beams = optics().beams();
    const sim::PoseTrack& track = *world_.robot(robot_);
    const sim::Time begin = fired(optics().first_step);
    const sim::Time end = fired(optics().last_step);
    const bool comes_or_goes = track.absent(begin) != track.absent(end);
    const double needed = comes_or_goes ? beams : world_.parts(begin, end);
    const int count = static_cast<int>(std::min<double>(needed, most_parts()));
    std::vector<Part> parts;
    for (int i = 0; i < count; ++i) {
        const sim::Beams shared = part_of(beams, i, count);
        const sim::Time time = fired(middle(optics(), shared));
        if (!track.absent(time)) parts.push_back({shared, time});
    }
    return parts;
}

}  // namespace scipd::daemon
