// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/check.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/config/config_file.h"
#include "daemon/config/file_kind.h"
#include "daemon/faults/scenario.h"
#include "daemon/plan/load_world.h"
#include "daemon/plan/mounting.h"
#include "daemon/plan/notices.h"
#include "daemon/plan/unlikely_places.h"
#include "daemon/world/backend_choice.h"
#include "sim/backends/registry.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/loaders/poses/trajectory_file.h"
#include "sim/world/bounds.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {
namespace {

using Sentences = std::vector<std::string>;

double length_m(const glm::dvec3& way_m) {
    return std::hypot(way_m.x, way_m.y, way_m.z);
}

/// Like printf().
template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
    std::array<char, 160> written{};
    std::snprintf(written.data(), written.size(), format, numbers...);
    return written.data();
}

/// In the order of the alphabet, and each once.
std::string listed(const std::set<std::string>& words) {
    constexpr std::size_t most = 12;
    std::string list;
    std::size_t count = 0;
    for (const std::string& word : words) {
        if (++count > most) return list + " and " + std::to_string(words.size() - most) + " more";
        list += (list.empty() ? "" : ", ") + word;
    }
    return list;
}

/// The lines, and then what the file is.
std::string answer(const Sentences& lines, const std::filesystem::path& file,
                   const std::string& what) {
    std::string said;
    for (const std::string& line : lines)
        said += line + "\n";
    return said + file.string() + ": no errors; " + what + "\n";
}

std::string materials_of(const sim::Scene& scene, const sim::MaterialLibrary& library) {
    std::set<std::string> names;
    std::set<std::string> unknown;
    for (const sim::Object& object : scene.objects) {
        const std::string& name = scene.materials[object.material].name;
        names.insert(name);
        if (library.find(name) == nullptr) unknown.insert(name);
    }
    if (names.empty()) return "";
    return ", materials: " + listed(names) +
           (unknown.empty() ? "" : " (not in the library: " + listed(unknown) + ")");
}

std::size_t triangles_of(const sim::Scene& scene) {
    std::size_t triangles = 0;
    for (const sim::Object& object : scene.objects) {
        const auto* mesh = std::get_if<sim::SharedMesh>(&object.shape);
        if (mesh != nullptr) triangles += (*mesh)->triangles.size();
    }
    return triangles;
}

std::string contents_of(const sim::Scene& scene, const sim::Bounds& extent) {
    const auto movable = std::ranges::count_if(scene.models, &sim::Model::movable);
    const auto lidars = std::ranges::count_if(
        scene.frames, [](const sim::Frame& frame) { return frame.lidar.has_value(); });
    std::string said = "models: " + std::to_string(scene.models.size());
    if (movable > 0) said += " (" + std::to_string(movable) + " movable)";
    said += ", objects: " + std::to_string(scene.objects.size()) +
            ", triangles of meshes: " + std::to_string(triangles_of(scene));
    if (!extent.empty()) {
        const glm::dvec3 size_m = extent.high_m - extent.low_m;
        said += text(", size: %.4g x %.4g x %.4g m from (%.4g %.4g %.4g)", size_m.x, size_m.y,
                     size_m.z, extent.low_m.x, extent.low_m.y, extent.low_m.z);
    }
    if (lidars > 0) said += ", lidars: " + std::to_string(lidars);
    return said;
}

std::string name_of(FileKind kind) {
    if (kind == FileKind::mesh) return "a mesh";
    return kind == FileKind::map ? "a ROS map" : "a world";
}

std::string check_scene(FileKind kind, const std::filesystem::path& file,
                        const Overrides& overrides) {
    Config config;
    config.scene = file;
    overrides.put_into(config);
    const LoadedMaterials materials = load_materials(config);
    // Without a sensor that sees light, materials that are unknown are no warning.
    sim::LoadedScene loaded = load_world(config, materials.library);
    const sim::Bounds extent = sim::extent_of(*loaded.scene);
    Sentences lines = std::move(loaded.warnings);
    constexpr double larger_than_most_m = 100.0;
    if (kind == FileKind::mesh && !extent.empty() &&
        length_m(extent.high_m - extent.low_m) > larger_than_most_m) {
        lines.push_back(file.string() +
                        ": is very large; if it is in millimetres, `scipctl scene add --scale "
                        "0.001` or a <scale> of 0.001 in an SDF shrinks it");
    }
    return answer(lines, file,
                  name_of(kind) + "; " + contents_of(*loaded.scene, extent) +
                      materials_of(*loaded.scene, *materials.library));
}

const char* name_of(sim::TrajectoryFormat format) {
    switch (format) {
        case sim::TrajectoryFormat::euroc:
            return "EuRoC";
        case sim::TrajectoryFormat::kitti:
            return "KITTI";
        case sim::TrajectoryFormat::csv:
            return "CSV";
        default:
            return "TUM";
    }
}

struct Drive {
    double duration_s = 0.0;
    double path_m = 0.0;
    double fastest_mps = 0.0;
    int jumps = 0;
};

Drive drive_of(const std::vector<sim::TimedPose>& poses) {
    const auto seconds = [](sim::Time time) { return std::chrono::duration<double>(time).count(); };
    Drive drive;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const double step_m =
            length_m(poses[i].pose.translation_m - poses[i - 1].pose.translation_m);
        const double speed_mps = step_m / seconds(poses[i].time - poses[i - 1].time);
        if (speed_mps > sim::PosePolicy{}.fastest_mps) ++drive.jumps;
        drive.path_m += step_m;
        drive.fastest_mps = std::max(drive.fastest_mps, speed_mps);
    }
    if (!poses.empty()) drive.duration_s = seconds(poses.back().time - poses.front().time);
    return drive;
}

std::string check_trajectory(const std::filesystem::path& file, bool strict) {
    const sim::Trajectory trajectory = sim::load_trajectory(file);
    if (strict && !trajectory.warnings.empty()) throw sim::LoadError(trajectory.warnings);
    const std::vector<sim::TimedPose>& poses = trajectory.poses;
    const Drive drive = drive_of(poses);
    std::string said = std::string("a trajectory (") + name_of(sim::format_of(file)) +
                       "); poses: " + std::to_string(poses.size()) +
                       text(", duration: %.3f s", drive.duration_s);
    if (drive.duration_s > 0.0) {
        said += text(", rate: %.4g Hz, path: %.4g m, fastest: %.3g m/s",
                     static_cast<double>(poses.size() - 1) / drive.duration_s, drive.path_m,
                     drive.fastest_mps);
    }
    if (drive.jumps > 0) said += ", jumps: " + std::to_string(drive.jumps);
    return answer(trajectory.warnings, file, said);
}

std::string check_scenario(const std::filesystem::path& file) {
    const Scenario scenario = load_scenario(file, std::nullopt);
    std::set<std::string> kinds;
    std::set<std::string> sensors;
    for (const ScenarioStep& step : scenario.steps) {
        kinds.insert(std::string(step.fault.kind->name));
        sensors.insert(step.sensor);
    }
    return answer({}, file,
                  "a scenario; steps: " + std::to_string(scenario.steps.size()) +
                      ", seed: " + std::to_string(scenario.seed) + ", kinds: " + listed(kinds) +
                      ", scanners: " + listed(sensors));
}

std::string check_materials(const std::filesystem::path& file) {
    sim::MaterialLibrary library;
    for (sim::MaterialOptics& material : sim::load_materials(file))
        library.add(std::move(material));
    return answer({}, file, "materials: " + summary_of(library));
}

/// `overrides` say how a world is read, and if they are strict, a warning is an error.
std::string check_file(FileKind kind, const std::filesystem::path& file,
                       const Overrides& overrides) {
    using enum FileKind;
    if (kind == world || kind == map || kind == mesh) return check_scene(kind, file, overrides);
    if (!overrides.xacro.empty() || overrides.geometry)
        throw sim::LoadError({file.string() + ": is no world: leave --xacro and --geometry out"});
    if (kind == trajectory) return check_trajectory(file, overrides.strict);
    return kind == scenario ? check_scenario(file) : check_materials(file);
}

void note_faults(Sentences& faults, const std::function<void()>& load) {
    try {
        load();
    } catch (const sim::LoadError& error) {
        faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
}

/// A backend that this machine has not what it takes for would keep scipd from starting.
void check_backends(const RobotConfig& robot, Sentences& faults) {
    for (const SensorConfig& sensor : robot.sensors) {
        const sim::BackendRow* backend = sim::find_backend(sensor.backend);
        if (backend == nullptr || backend->probe == nullptr) continue;
        try {
            (void)backend->make(std::make_shared<const sim::Scene>(), sensor.depth);
        } catch (const std::runtime_error& error) {
            faults.push_back("robots." + robot.name + ".sensors." + sensor.name +
                             ".backend: " + error.what() + advice_instead_of(*backend));
        }
    }
}

/// How many curves of errors the scanners have (noise, bias, light), and which share of them has no
/// source: "6, 67 % of them assumed".
std::string summary_of_curves(const Config& config) {
    long curves = 0;
    long assumed = 0;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (sensor.staring) continue;
            const Sureness& sure = sensor.model.sureness;
            const std::array known{sure.noise, sure.bias, sure.light};
            curves += std::ssize(known);
            assumed += std::ranges::count(known, Evidence::deduced) +
                       std::ranges::count(known, Evidence::assumed);
        }
    }
    const double share = 100.0 * double(assumed) / double(std::max(1L, curves));
    return std::to_string(curves) + ", " + std::to_string(std::lround(share)) +
           " % of them assumed";
}

std::string check_configuration(const std::filesystem::path& file, const Options& options) {
    Config config = load_config(file);
    options.overrides.put_into(config);
    sim::LoadedScene world;
    Sentences faults;
    std::vector<std::string> notices;
    LoadedMaterials materials;
    note_faults(faults, [&] { materials = load_materials(config); });
    note_faults(faults, [&] {
        world = load_world(config, materials.library);
        notices = mount_by_name(config, *world.scene);
        std::ranges::move(warnings_of(config, *world.scene), std::back_inserter(world.warnings));
    });
    note_faults(faults, [&] { (void)load_scenario(config); });
    LoadedTrajectories trajectories;
    note_faults(faults, [&] { trajectories = load_trajectories(config); });
    std::size_t sensors = 0;
    for (const RobotConfig& robot : config.robots) {
        check_backends(robot, faults);
        sensors += robot.sensors.size();
    }
    std::ranges::move(serial_notices(config, {}), std::back_inserter(notices));
    std::ranges::move(media_notices(config), std::back_inserter(notices));
    if (world.scene && materials.library)
        std::ranges::move(material_notices(config, *world.scene, *materials.library),
                          std::back_inserter(notices));
    if (!faults.empty()) throw sim::LoadError(std::move(faults));
    std::string text;
    for (const auto* list :
         {&materials.warnings, &world.warnings, &trajectories.warnings, &notices}) {
        for (const std::string& line : *list)
            text += line + "\n";
    }
    return text + file.string() + ": no errors; robots: " + std::to_string(config.robots.size()) +
           ", sensors: " + std::to_string(sensors) +
           ", models: " + std::to_string(world.scene->models.size()) +
           ", materials: " + summary_of(*materials.library) +
           ", error curves: " + summary_of_curves(config) + "\n";
}

}  // namespace

std::string check(const std::filesystem::path& file, const Options& options) {
    const auto kind = kind_of(file);
    if (!kind) throw sim::LoadError({file.string() + ": " + kind.error().why});
    if (*kind == FileKind::configuration) return check_configuration(file, options);
    return check_file(*kind, file, options.overrides);
}

}  // namespace scipd::daemon
