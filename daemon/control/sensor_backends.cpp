// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/sensor_backends.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <glm/trigonometric.hpp>
#include <spdlog/spdlog.h>

#include "sim/backends/choice.h"
#include "sim/backends/depth.h"
#include "sim/backends/registry.h"

namespace scipd::daemon {
namespace {

constexpr const char* rays = "embree";
constexpr const char* depth = "depth";

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

/// All backends for one scene, each made when it is first asked for.
class Workshop {
  public:
    explicit Workshop(sim::SharedScene scene)
        : scene_(std::move(scene)), faces_(faces_of(*scene_)) {}

    void serve(const BackendWish& wish, SensorBackends& backends) {
        const SharedChoice choice = settle(wish);
        try {
            backends.assign(wish.sensor, backend(choice->backend, wish.depth), choice);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(wish.sensor + ": backend " + choice->backend + ": " +
                                     error.what() + "; use auto or embree");
        }
    }

  private:
    using Kind = std::tuple<std::string, sim::BetweenPixels, double, double>;

    std::shared_ptr<sim::RangeBackend> backend(const std::string& name,
                                               const sim::DepthOptions& options) {
        const bool drawn = name == depth;
        const sim::DepthOptions used = drawn ? options : sim::DepthOptions{};
        auto& made = made_[Kind{name, used.between_pixels, used.oversample, used.widest_pass_rad}];
        if (!made) {
            made = drawn ? sim::make_depth_backend(scene_, used) : sim::make_backend(name, scene_);
        }
        return made;
    }

    SharedChoice settle(const BackendWish& wish) {
        if (wish.backend != "auto") {
            return std::make_shared<const BackendChoice>(BackendChoice{wish.backend, {}, {}});
        }
        const SharedChoice& settled = wish.settled;
        const bool stays = settled && (!settled->faces || !changed_much(*settled->faces, faces_)) &&
                           (settled->backend != depth || can_draw(wish.depth));
        return stays ? settled : std::make_shared<const BackendChoice>(measure(wish));
    }

    BackendChoice measure(const BackendWish& wish) {
        if (!can_draw(wish.depth)) return {rays, "no depth: " + why_not_, faces_};
        const std::array contenders{backend(rays, {}).get(), backend(depth, wish.depth).get()};
        const Sweeps sweeps(wish);
        try {
            const sim::Choice choice = sim::choose(contenders, sweeps.fans(), now);
            return {choice.contender == 0 ? rays : depth, choice.reason, faces_};
        } catch (const std::runtime_error& error) {
            return {rays, std::string("no depth: ") + error.what(), faces_};
        }
    }

    bool can_draw(const sim::DepthOptions& options) {
        try {
            backend(depth, options);
            return true;
        } catch (const std::runtime_error& error) {
            why_not_ = error.what();
            return false;
        }
    }

    sim::SharedScene scene_;
    std::size_t faces_;
    std::map<Kind, std::shared_ptr<sim::RangeBackend>> made_;
    std::string why_not_;
};

}  // namespace

void SensorBackends::assign(const std::string& sensor, std::shared_ptr<sim::RangeBackend> backend,
                            SharedChoice choice) {
    if (std::ranges::find(backends_, backend.get()) == backends_.end())
        backends_.push_back(backend.get());
    sensors_[sensor] = {std::move(backend), std::move(choice)};
}

void SensorBackends::log_changes_since(const SensorBackends& before) const {
    for (const auto& [sensor, assigned] : sensors_) {
        const BackendChoice& choice = *assigned.choice;
        const auto known = before.sensors_.find(sensor);
        const bool known_choice =
            known != before.sensors_.end() && known->second.choice == assigned.choice;
        if (known_choice || !choice.faces) continue;
        spdlog::info("{}: auto takes {}: {}", sensor, choice.backend, choice.reason);
    }
}

void SensorBackends::leave_thread() {
    for (sim::RangeBackend* backend : backends_)
        backend->leave_thread();
}

SensorBackends make_backends(std::span<const BackendWish> wishes, const sim::SharedScene& scene) {
    SensorBackends backends;
    {
        Workshop workshop(scene);
        for (const BackendWish& wish : wishes)
            workshop.serve(wish, backends);
    }
    backends.leave_thread();
    return backends;
}

SharedChoice rays_unmeasured(std::string why) {
    return std::make_shared<const BackendChoice>(BackendChoice{rays, std::move(why), {}});
}

}  // namespace scipd::daemon
