// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/sweep.h"

#include <algorithm>
#include <span>
#include <utility>

#include "sim/backends/surroundings.h"
#include "sim/recycled.h"
#include "sim/sensor/encounters.h"
#include "sim/sensor/equal_parts.h"
#include "sim/sensor/shared_scan.h"
#include "sim/world/poses_along.h"

namespace scipd::daemon {
namespace {

/// Within a turn the mirror's speed does not change, so its beams are fired evenly. To ask when
/// each of them is fired would take longer than to work out where the sensor is then.
std::vector<sim::Time> evenly_between(sim::Time begin, sim::Time end, std::size_t count) {
    const double apart_ns =
        static_cast<double>((end - begin).count()) / static_cast<double>(count - 1);
    std::vector<sim::Time> times = sim::Recycled<sim::Time>::take(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double since_ns = apart_ns * static_cast<double>(i) + 0.5;
        times[i] = begin + sim::Time(static_cast<std::int64_t>(since_ns));
    }
    return times;
}

}  // namespace

Sweep::Sweep(World& world, std::string robot, const SensorConfig& config, sim::Scanner scanner)
    : world_(world),
      robot_(std::move(robot)),
      name_(sensor_name(robot_, config.name)),
      robot_from_sensor_(config.robot_from_sensor),
      motion_(config.motion),
      sees_body_(config.sees_body),
      mount_(config.mount),
      looks_around_(!config.staring && 2 * scanner.spec().beams() >= scanner.spec().steps_per_turn),
      disturbed_(config.interference),
      scanner_(std::move(scanner)),
      read_with_(std::make_shared<const sim::SensorSpec>(scanner_.spec())) {}

void Sweep::read_as(sim::Scanner scanner, bool disturbed) {
    scanner_ = std::move(scanner);
    read_with_ = std::make_shared<const sim::SensorSpec>(scanner_.spec());
    disturbed_ = disturbed;
}

std::size_t Sweep::beams() const {
    return static_cast<std::size_t>(optics().beams());
}

std::size_t Sweep::most_poses() const {
    return motion_ ? std::min(static_cast<std::size_t>(*motion_), beams()) : beams();
}

Measurement Sweep::measure(std::int64_t revolution, sim::Time start, const Fired& fired,
                           sim::Time origin, sim::Time on_for) {
    const auto beam_fired = [&](std::size_t beam) {
        return fired(optics().first_step + static_cast<int>(beam));
    };
    std::vector<sim::Time> times = pose_times(beam_fired);
    sim::Scan scan = scanner_.begin(revolution, start, poses_at(times));
    scan.posed_at = std::move(times);
    const sim::SharedLitWorld lit =
        scanner_.sees_light()
            ? world_.light().shine(world_.scene(), optics().receiver.wavelength_nm)
            : nullptr;
    const sim::Conditions conditions{.lit = lit.get(), .on_for = on_for};
    cast(scan, beam_fired, conditions);
    if (disturbed_) look_at_lamps(scan, beam_fired);
    scanner_.read(scan, conditions);
    return measurement_of(sim::share(std::move(scan)), origin);
}

Measurement Sweep::measurement_of(sim::SharedScan scan, sim::Time origin) const {
    return {.cast = std::move(scan),
            .scene = world_.names(),
            .backend = world_.choice_of(name_),
            .optics = read_with_,
            .origin = origin};
}

std::vector<sim::Time> Sweep::pose_times(const BeamFired& fired) const {
    const sim::Time begin = fired(0);
    const sim::Time end = fired(beams() - 1);
    if (begin == end || world_.robot(robot_)->still(begin - shift_.late, end - shift_.late))
        return {begin};
    if (most_poses() == beams()) return evenly_between(begin, end, beams());
    std::vector<sim::Time> times;
    times.reserve(beams());
    for (std::size_t i = 0; i < most_poses(); ++i) {
        const sim::Beams shared = sim::equal_part(beams(), i, most_poses());
        times.resize(shared.first + shared.count, fired(sim::middle_of(shared)));
    }
    return times;
}

std::vector<sim::Pose> Sweep::poses_at(const std::vector<sim::Time>& times) const {
    const sim::PoseTrack& track = *world_.robot(robot_);
    if (shift_ == PoseShift{}) return sim::poses_along(track, robot_from_sensor_, times);
    std::vector<sim::Pose> poses;
    poses.reserve(times.size());
    for (const sim::Time time : times)
        poses.push_back(shifted_pose_at(track, time) * robot_from_sensor_);
    return poses;
}

sim::Pose Sweep::shifted_pose_at(const sim::PoseTrack& track, sim::Time time) const {
    const sim::Pose pose = shift_.stopped ? *shift_.stopped : track.at(time - shift_.late);
    return {pose.translation_m + shift_.jump.translation_m, shift_.jump.rotation * pose.rotation};
}

void Sweep::cast(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions) {
    const sim::PoseTrack& track = *world_.robot(robot_);
    const bool absent = track.absent(fired(0));
    const bool comes_or_goes = absent != track.absent(fired(beams() - 1));
    if (absent && !comes_or_goes) return;
    const sim::Unseen unseen = this->unseen();
    if (motion_) {
        cast_in_equal_parts(scan, fired, conditions, unseen);
    } else {
        cast_as_met(scan, fired, conditions, unseen);
    }
    if (comes_or_goes) return forget_absent(scan, fired);
    world_.tell_cast({robot_, name_, scan, looks_around_, unseen.objects});
}

sim::Unseen Sweep::unseen() {
    const sim::ModelId body = world_.body_of(robot_);
    if (body != sim::no_model && !sees_body_) return body;
    const sim::SharedScene& scene = world_.scene();
    if (housed_in_.lock() == scene) return {sim::no_model, housing_};
    // A model that cannot move is no body, yet it may carry the sensor.
    const auto carrier = body == sim::no_model && mount_ ? sim::find_model(*scene, mount_->model)
                                                         : std::optional(body);
    housed_in_ = scene;
    housing_ = sim::housing_of(*scene, carrier.value_or(sim::no_model), mount_ ? mount_->link : "",
                               robot_from_sensor_, scanner_.directions());
    return {sim::no_model, housing_};
}

void Sweep::cast_as_met(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions,
                        const sim::Unseen& unseen) {
    sim::RangeBackend& backend = world_.backend(name_);
    if (backend.casts_apart() && !scanner_.follows_light(backend, conditions))
        return cast_apart(scan, fired, conditions, unseen);
    const std::vector<sim::Mover> movers =
        world_.movers().all(fired(0), fired(beams() - 1), unseen.model);
    for (const sim::Part& part :
         sim::parts_of_sweep(optics(), scan.world_from_sensor, fired, movers)) {
        for (const auto& [mover, time] : part.updates)
            backend.move(movers[mover].id, movers[mover].path->at(time));
        scanner_.cast(backend, scan, part.beams, conditions, unseen, part.can_meet);
    }
}

void Sweep::cast_apart(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions,
                       const sim::Unseen& unseen) {
    sim::RangeBackend& backend = world_.backend(name_);
    const std::span<const sim::ModelId> none;
    scanner_.cast(backend, scan, {0, beams()}, conditions, unseen, none);
    if (world_.movers().empty()) return;
    const sim::SensorMotion motion = sim::motion_of(scan.world_from_sensor);
    const Ball reach{motion.middle.translation_m, optics().max_range_m + motion.moved_m};
    const std::vector<sim::Mover> movers =
        world_.movers().within(reach, fired(0), fired(beams() - 1), unseen.model);
    if (movers.empty()) return;
    for (const auto& [index, beams, time] :
         sim::passings_of_sweep(optics(), motion, scan, fired, movers)) {
        const sim::Mover& mover = movers[index];
        backend.move(mover.id, mover.path->at(time));
        scanner_.cast_moving(backend, scan, beams, mover.id, unseen);
    }
}

void Sweep::cast_in_equal_parts(sim::Scan& scan, const BeamFired& fired,
                                const sim::Conditions& conditions, const sim::Unseen& unseen) {
    const std::vector<sim::Mover> movers =
        world_.movers().all(fired(0), fired(beams() - 1), unseen.model);
    sim::RangeBackend& backend = world_.backend(name_);
    for (const auto& [part, time] : sim::equal_parts(beams(), most_poses(), fired, movers)) {
        for (const sim::Mover& mover : movers)
            backend.move(mover.id, mover.path->at(time));
        scanner_.cast(backend, scan, part, conditions, unseen);
    }
}

sim::Pose Sweep::pose_at(sim::Time time) const {
    return world_.robot(robot_)->at(time) * robot_from_sensor_;
}

void Sweep::look_at_lamps(sim::Scan& scan, const BeamFired& fired) const {
    for (const Lamp* const lamp : world_.light().lamps().all()) {
        if (lamp == own_) continue;
        for (std::size_t beam = 0; beam < beams(); ++beam) {
            const auto shines = lamp->shines(fired(beam));
            if (!shines) continue;
            const bool one_pose = scan.world_from_sensor.size() == 1;
            const sim::Pose& pose = scan.world_from_sensor[one_pose ? 0 : beam];
            const glm::dvec3 direction{scanner_.directions()[beam * scan.rays_per_beam]};
            const Gaze gaze{pose.translation_m, pose.rotation * direction,
                            optics().footprint.half_width_rad, scan.middle(beam).range_m};
            if (dazzles(*shines, gaze)) scan.dazzled.push_back(static_cast<std::uint32_t>(beam));
        }
    }
}

// While it is absent it is nowhere, and not where it was last.
void Sweep::forget_absent(sim::Scan& scan, const BeamFired& fired) const {
    const sim::PoseTrack& track = *world_.robot(robot_);
    for (std::size_t i = 0; i < most_poses(); ++i) {
        const sim::Beams part = sim::equal_part(beams(), i, most_poses());
        if (!track.absent(fired(sim::middle_of(part)))) continue;
        const std::size_t first = part.first * scan.rays_per_beam;
        const std::size_t end = first + part.count * scan.rays_per_beam;
        std::ranges::fill(std::span(scan.hits).subspan(first, end - first), sim::Hit{});
        std::erase_if(scan.farther, [&](const sim::FartherHit& hit) {
            return hit.ray >= first && hit.ray < end;
        });
    }
}

}  // namespace scipd::daemon
