// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/backend_workshop.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/trigonometric.hpp>

#include "sim/backends/choice.h"
#include "sim/backends/depth.h"
#include "sim/backends/registry.h"

namespace scipd::daemon {
namespace {

constexpr const char* rays = "embree";
constexpr const char* depth = "depth";

/// What helps where this one cannot be made.
std::string instead_of(const std::string& backend) {
    if (backend == depth) return "; use auto or embree";
    return backend == rays ? "; give scipd more memory, or use reference, which is slow" : "";
}

/// How much work a scene is for any backend, roughly.
std::size_t faces_of(const sim::Scene& scene) {
    std::size_t faces = 0;
    for (const sim::Object& object : scene.objects) {
        const auto* mesh = std::get_if<sim::SharedMesh>(&object.shape);
        faces += mesh != nullptr ? (*mesh)->triangles.size() : 1;
    }
    return faces;
}

/// By more than half of the smaller one.
bool changed_much(std::size_t before, std::size_t now) {
    return 2 * std::max(before, now) > 3 * std::min(before, now);
}

sim::Time now() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

/// Some sweeps of a sensor that turns on the spot, each with another quarter of the world ahead.
class Sweeps {
  public:
    explicit Sweeps(const BackendWish& wish) {
        constexpr double turned_rad = 0.05;  // while it sweeps
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const double heading_rad = glm::radians(90.0) * double(i);
            const std::size_t beams = wish.directions.size();
            const auto poses = std::min(beams, static_cast<std::size_t>(wish.poses));
            for (std::size_t beam = 0; beam < (poses > 1 ? beams : 1); ++beam) {
                const std::size_t part = beam * poses / beams;
                const double yaw_rad = heading_rad + turned_rad * double(part) / double(poses);
                poses_[i].push_back(wish.world_from_sensor *
                                    sim::pose_from_rpy({0, 0, 0}, {0, 0, yaw_rad}));
            }
            fans_[i] = {wish.directions, poses_[i], wish.max_range_m};
        }
    }

    [[nodiscard]] std::span<const sim::Fan> fans() const { return fans_; }

  private:
    std::array<std::vector<sim::Pose>, 2> poses_;
    std::array<sim::Fan, 2> fans_;
};

/// A sweep without motion, so that what its first one takes (plans, shaders, memory) is not taken
/// from those who wait for a scan.
void warm_up(sim::RangeBackend& backend, const BackendWish& wish) {
    const std::array pose{wish.world_from_sensor};
    std::vector<sim::Hit> hits(wish.directions.size());
    backend.cast({wish.directions, pose, wish.max_range_m}, hits);
}

}  // namespace

BackendWorkshop::BackendWorkshop(sim::SharedScene scene)
    : scene_(std::move(scene)), faces_(faces_of(*scene_)) {}

bool BackendWorkshop::is_open(const BackendWish& wish) const {
    if (wish.backend != "auto") return false;
    const bool measured = wish.settled && wish.settled->faces;
    return !measured || changed_much(*wish.settled->faces, faces_);
}

SharedChoice BackendWorkshop::measure(const BackendWish& wish, const std::function<bool()>& ended) {
    auto choice = std::make_shared<const BackendChoice>(fastest(wish, ended));
    leave_thread();
    return choice;
}

BackendChoice BackendWorkshop::fastest(const BackendWish& wish,
                                       const std::function<bool()>& ended) {
    try {
        const std::array contenders{backend(rays, {}).get(), backend(depth, wish.depth).get()};
        const Sweeps sweeps(wish);
        const sim::Choice choice = sim::choose(contenders, sweeps.fans(), now, {.ended = ended});
        return {choice.contender == 0 ? rays : depth, choice.reason, faces_};
    } catch (const std::runtime_error& error) {
        return {rays, std::string("no depth: ") + error.what(), faces_};
    }
}

SensorBackends BackendWorkshop::make(std::span<const BackendWish> wishes) {
    SensorBackends backends;
    for (const BackendWish& wish : wishes) {
        const SharedChoice choice = settled(wish);
        try {
            const SharedBackend made = backend(choice->backend, wish.depth);
            if (choice->backend == depth) warm_up(*made, wish);
            backends.assign(wish.sensor, made, choice);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(wish.sensor + ": backend " + choice->backend + ": " +
                                     error.what() + instead_of(choice->backend));
        }
    }
    leave_thread();
    return backends;
}

SharedChoice BackendWorkshop::settled(const BackendWish& wish) {
    if (wish.backend != "auto")
        return std::make_shared<const BackendChoice>(BackendChoice{wish.backend, {}, {}});
    if (!wish.settled) return rays_unmeasured("not measured yet");
    if (wish.settled->backend != depth) return wish.settled;
    try {
        backend(depth, wish.depth);
        return wish.settled;
    } catch (const std::runtime_error& error) {
        return std::make_shared<const BackendChoice>(
            BackendChoice{rays, std::string("no depth: ") + error.what(), faces_});
    }
}

BackendWorkshop::SharedBackend BackendWorkshop::backend(const std::string& name,
                                                        const sim::DepthOptions& options) {
    const bool drawn = name == depth;
    const sim::DepthOptions used = drawn ? options : sim::DepthOptions{};
    auto& made = made_[Kind{name, used.between_pixels, used.oversample, used.widest_pass_rad}];
    if (!made) {
        made = drawn ? sim::make_depth_backend(scene_, used) : sim::make_backend(name, scene_);
    }
    return made;
}

void BackendWorkshop::leave_thread() {
    for (const auto& [kind, made] : made_) {
        if (made) made->leave_thread();
    }
}

}  // namespace scipd::daemon
