// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/backend_maker.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/trigonometric.hpp>

#include "sim/backends/choice.h"
#include "sim/backends/registry.h"
#include "sim/takes_long.h"
#include "sim/world/lit_world.h"

namespace scipd::daemon {
namespace {

/// A name that is in the registry: the configuration was checked, and choices are made from rows.
const sim::BackendRow& row_of(std::string_view name) {
    const sim::BackendRow* row = sim::find_backend(name);
    assert(row != nullptr);
    return *row;
}

std::string missing(const sim::BackendRow& row, const std::runtime_error& why) {
    return "no " + std::string(row.name) + ": " + why.what();
}

/// Most triangles that `auto` tries to draw. Drawing takes about 100 bytes of memory for each, and
/// so many are ready within 0.2 s.
constexpr double most_drawn = 1e6;

/// About as many triangles as sim::tessellate() makes of a shape, which takes long.
double drawn_triangles(const sim::Shape& shape) {
    using std::numbers::pi;
    const auto in_tolerances = [](double m) { return m / sim::chord_tolerance_m; };
    if (const auto* mesh = std::get_if<sim::SharedMesh>(&shape))
        return static_cast<double>((*mesh)->triangles.size());
    if (const auto* sphere = std::get_if<sim::Sphere>(&shape))
        return std::min(1e6, 0.5 * pi * pi * in_tolerances(sphere->radius_m));
    const auto* cylinder = std::get_if<sim::Cylinder>(&shape);
    return cylinder != nullptr ? 2.0 * pi * std::sqrt(in_tolerances(cylinder->radius_m)) : 12.0;
}

/// Roughly how much work the scene is for any backend.
std::size_t faces_of(const sim::Scene& scene) {
    std::size_t faces = 0;
    for (const sim::Object& object : scene.objects) {
        const auto* mesh = std::get_if<sim::SharedMesh>(&object.shape);
        faces += mesh != nullptr ? (*mesh)->triangles.size() : 1;
    }
    return faces;
}

/// Whether they differ by more than half of the smaller one.
bool changed_much(std::size_t before, std::size_t now) {
    return 2 * std::max(before, now) > 3 * std::min(before, now);
}

sim::Time now() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

/// Two sweeps of a sensor that turns on the spot. Each looks at another quarter of the world.
class Sweeps {
  public:
    explicit Sweeps(const RequestedBackend& request) {
        constexpr double turned_rad = 0.05;  // while it sweeps
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const double heading_rad = glm::radians(90.0) * double(i);
            const std::size_t beams = request.directions.size();
            const auto poses = std::min(beams, static_cast<std::size_t>(request.poses));
            for (std::size_t beam = 0; beam < (poses > 1 ? beams : 1); ++beam) {
                const std::size_t part = beam * poses / beams;
                const double yaw_rad = heading_rad + turned_rad * double(part) / double(poses);
                poses_[i].push_back(request.world_from_sensor *
                                    sim::pose_from_rpy({0, 0, 0}, {0, 0, yaw_rad}));
            }
            fans_[i] = {request.directions, poses_[i], request.max_range_m};
        }
    }

    [[nodiscard]] std::span<const sim::Fan> fans() const { return fans_; }

  private:
    std::array<std::vector<sim::Pose>, 2> poses_;
    std::array<sim::Fan, 2> fans_;
};

/// Casts a sweep without motion, so that nobody waits for a scan while the first cast makes its
/// plans, shaders and memory.
void warm_up(sim::RangeBackend& backend, const RequestedBackend& request) {
    const std::array pose{request.world_from_sensor};
    std::vector<sim::Hit> hits(request.directions.size());
    backend.cast({request.directions, pose, request.max_range_m}, hits);
}

}  // namespace

BackendMaker::BackendMaker(sim::SharedScene scene)
    : scene_(std::move(scene)), faces_(faces_of(*scene_)) {
    for (const sim::Object& object : scene_->objects)
        triangles_ += drawn_triangles(object.shape);
}

std::string BackendMaker::too_large(const sim::BackendRow& row) const {
    if (!row.draws || triangles_ <= most_drawn) return {};
    return "no " + std::string(row.name) + ": the world has about " +
           std::to_string(std::llround(triangles_)) + " triangles to draw, and auto draws up to " +
           std::to_string(std::llround(most_drawn));
}

bool BackendMaker::is_open(const RequestedBackend& request) const {
    if (request.backend || needs_rays(request)) return false;
    const bool measured = request.settled && request.settled->faces;
    return !measured || changed_much(*request.settled->faces, faces_);
}

bool BackendMaker::needs_rays(const RequestedBackend& request) const {
    return request.materials &&
           sim::light_goes_on(*scene_, *request.materials, request.wavelength_nm);
}

SharedChoice BackendMaker::measure(const RequestedBackend& request,
                                   const std::function<bool()>& ended) {
    auto choice = std::make_shared<const BackendChoice>(fastest(request, ended));
    leave_thread();
    return ended && ended() ? nullptr : choice;
}

// The preferred backend is the first contender, and the yardstick for the others.
BackendChoice BackendMaker::fastest(const RequestedBackend& request,
                                    const std::function<bool()>& ended) {
    const std::string preferred(sim::preferred_backend().name);
    if (const std::string why = too_large(sim::drawing_backend()); !why.empty())
        return {preferred, why, faces_};
    std::vector<sim::Contender> contenders;
    std::string reason;
    for (const sim::BackendRow& row : sim::backends()) {
        if (row.slow) continue;
        if (ended && ended()) return {};
        try {
            contenders.push_back({row.name, backend(row, request).get()});
        } catch (const std::runtime_error& error) {
            reason += (reason.empty() ? "" : "; ") + missing(row, error);
        }
    }
    if (contenders.size() < 2 || contenders.front().name != preferred)
        return {preferred, reason, faces_};
    try {
        const Sweeps sweeps(request);
        const sim::Choice choice = sim::choose(contenders, sweeps.fans(), now, {.ended = ended});
        reason = choice.reason + (reason.empty() ? "" : "; ") + reason;
        return {std::string(contenders[choice.contender].name), reason, faces_};
    } catch (const std::runtime_error& error) {  // a driver failed
        return {preferred, missing(sim::drawing_backend(), error), faces_};
    }
}

SensorBackends BackendMaker::make(std::span<const RequestedBackend> requests) {
    SensorBackends backends;
    std::set<std::size_t> shards;
    for (const RequestedBackend& request : requests)
        shards.insert(request.shard);
    for (const std::size_t shard : shards) {
        for (const RequestedBackend& request : requests) {
            if (request.shard == shard) make(request, backends);
        }
        // Backends that draw share what they draw with as long as it is bound to this thread, and
        // two shards must not.
        leave_thread();
    }
    return backends;
}

void BackendMaker::make(const RequestedBackend& request, SensorBackends& backends) {
    const SharedChoice choice = settled(request);
    const sim::BackendRow& row = row_of(choice->backend);
    try {
        const SharedBackend made = backend(row, request);
        if (row.draws) warm_up(*made, request);
        backends.assign(request.sensor, made, choice, request.shard);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(request.sensor + ": backend " + choice->backend + ": " +
                                 error.what() + advice_instead_of(row));
    }
}

SharedChoice BackendMaker::settled(const RequestedBackend& request) {
    if (request.backend)
        return std::make_shared<const BackendChoice>(BackendChoice{*request.backend, {}, {}});
    if (needs_rays(request))
        return unmeasured_choice("light goes on behind glass or from mirrors, and rays follow it");
    if (!request.settled) return unmeasured_choice("not measured yet");
    const sim::BackendRow& row = row_of(request.settled->backend);
    const sim::BackendRow& preferred = sim::preferred_backend();
    if (&row == &preferred) return request.settled;
    if (const std::string why = too_large(row); !why.empty()) {
        return std::make_shared<const BackendChoice>(
            BackendChoice{std::string(preferred.name), why, faces_});
    }
    try {
        backend(row, request);
        return request.settled;
    } catch (const std::runtime_error& error) {
        return std::make_shared<const BackendChoice>(
            BackendChoice{std::string(preferred.name), missing(row, error), faces_});
    }
}

BackendMaker::SharedBackend BackendMaker::backend(const sim::BackendRow& row,
                                                  const RequestedBackend& request) {
    const sim::DepthOptions used = row.draws ? request.depth : sim::DepthOptions{};
    auto& made = made_[{row.name, used.between_pixels, used.oversample, used.widest_pass_rad,
                        request.shard}];
    if (!made) {
        sim::takes_long();
        made = row.make(scene_, used);
    }
    return made;
}

void BackendMaker::leave_thread() {
    for (const auto& [key, made] : made_) {
        if (made) made->leave_thread();
    }
}

SensorBackends make_backends(std::span<const RequestedBackend> requests,
                             const sim::SharedScene& scene) {
    return BackendMaker(scene).make(requests);
}

}  // namespace scipd::daemon
