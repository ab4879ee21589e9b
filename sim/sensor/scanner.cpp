// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scanner.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "sim/recycled.h"
#include "sim/sensor/echo_model.h"
#include "sim/sensor/light_path.h"
#include "sim/sensor/shared_scan.h"

namespace scipd::sim {
namespace {

/// A sensor that sees no light has beams without width.
SensorSpec as_seen(SensorSpec spec, Accuracy accuracy) {
    if (accuracy != Accuracy::material) spec.footprint.rays = 1;
    return spec;
}

}  // namespace

Scanner::Scanner(SensorSpec spec, const ErrorModel& errors)
    : spec_(as_seen(std::move(spec), errors.accuracy)),
      curves_(spec_),
      pattern_(spec_),
      errors_(errors) {}

Scanner::Scanner(SensorSpec spec, BeamPattern pattern, const ErrorModel& errors)
    : spec_(std::move(spec)), curves_(spec_), pattern_(std::move(pattern)), errors_(errors) {
    assert(pattern_.directions().size() == static_cast<std::size_t>(spec_.beams()));
}

SharedScan Scanner::measure(RangeBackend& backend, std::int64_t revolution, Time start,
                            std::vector<Pose> world_from_sensor,
                            const Conditions& conditions) const {
    Scan scan = begin(revolution, start, std::move(world_from_sensor));
    cast(backend, scan, {0, scan.beams()}, conditions);
    read(scan, conditions);
    return share(std::move(scan));
}

Scan Scanner::begin(std::int64_t revolution, Time start,
                    std::vector<Pose> world_from_sensor) const {
    assert(world_from_sensor.size() == 1 ||
           world_from_sensor.size() == static_cast<std::size_t>(spec_.beams()));
    Scan scan;
    scan.revolution = revolution;
    scan.start = start;
    scan.world_from_sensor = std::move(world_from_sensor);
    scan.rays_per_beam = pattern_.rays_per_beam();
    scan.hits = Recycled<Hit>::take(pattern_.directions().size());
    std::ranges::fill(scan.hits, Hit{});
    return scan;
}

void Scanner::cast(RangeBackend& backend, Scan& scan, Beams beams, const Conditions& conditions,
                   const Unseen& unseen, std::optional<std::span<const ModelId>> can_meet) const {
    Fan fan = fan_of(scan, beams);
    fan.unseen = unseen;
    fan.can_meet = can_meet;
    const std::span<Hit> hits = hits_of(scan, beams);
    if (!follows_light(backend, conditions)) return backend.cast(fan, hits);
    std::vector<glm::vec3> normals(hits.size());
    backend.cast(fan, hits, normals);
    const auto first = static_cast<std::uint32_t>(beams.first * pattern_.rays_per_beam());
    follow_light(backend, fan, *conditions.lit, first, hits, normals, scan.farther);
}

bool Scanner::follows_light(const RangeBackend& backend, const Conditions& conditions) const {
    return sees_light() && conditions.lit != nullptr && conditions.lit->light_goes_on() &&
           backend.follows_light();
}

void Scanner::cast_moving(RangeBackend& backend, Scan& scan, Beams beams, ModelId model,
                          const Unseen& unseen) const {
    Fan fan = fan_of(scan, beams);
    fan.unseen = unseen;
    fan.can_meet = {&model, 1};
    backend.cast_moving(fan, hits_of(scan, beams));
}

Fan Scanner::fan_of(const Scan& scan, Beams beams) const {
    const std::size_t rays = pattern_.rays_per_beam();
    const std::span<const Pose> poses = scan.world_from_sensor;
    return {
        .directions = pattern_.directions().subspan(beams.first * rays, beams.count * rays),
        .world_from_sensor = poses.size() == 1 ? poses : poses.subspan(beams.first, beams.count),
        .max_range_m = static_cast<float>(spec_.max_range_m),
        .directions_per_pose = rays};
}

std::span<Hit> Scanner::hits_of(Scan& scan, Beams beams) const {
    const std::size_t rays = pattern_.rays_per_beam();
    return std::span(scan.hits).subspan(beams.first * rays, beams.count * rays);
}

void Scanner::read(Scan& scan, const Conditions& conditions) const {
    if (sees_light() && conditions.lit != nullptr)
        find_echoes(scan, spec_, pattern_, *conditions.lit, errors_.key());
    errors_.read(spec_, curves_, conditions.on_for, scan);
}

}  // namespace scipd::sim
