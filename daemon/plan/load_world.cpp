// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_world.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "daemon/config/demo_world.h"
#include "daemon/config/world_options.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"

namespace scipd::daemon {
namespace {

std::string movable_models(const sim::Scene& scene) {
    std::string text;
    for (const sim::Model& model : scene.models) {
        if (model.movable) text += (text.empty() ? "" : ", ") + model.name;
    }
    return text.empty() ? "none" : text;
}

bool moves(const sim::Scene& scene, const std::string& name) {
    const auto model = sim::find_model(scene, name);
    return model && scene.models[*model].movable;
}

sim::LoadedScene load_scene(const Config& config, const sim::SharedMaterials& materials,
                            const std::stop_token& stop) {
    // Whoever plays recordings alone looks at none.
    if (config.scene.empty()) return {std::make_shared<const sim::Scene>(), {}};
    sim::SceneOptions options = scene_options(config, materials);
    options.limits.stop = stop;
    try {
        sim::LoadedScene loaded = sim::load_scene(config.scene, options);
        if (!config.xacro.empty() && sim::extension_of(config.scene) != ".xacro") {
            loaded.warnings.push_back(config.scene.string() +
                                      ": is not written in xacro; the xacro arguments are ignored");
            if (config.strict) throw sim::LoadError(loaded.warnings);
        }
        return loaded;
    } catch (const sim::LoadError& error) {
        throw named_at(config.place_of("scene"), error);
    }
}

/// Cameras and rangers have no faults.
std::vector<std::string> scanners_of(const Config& config) {
    std::vector<std::string> scanners;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (!sensor.staring) scanners.push_back(sensor_name(robot.name, sensor.name));
        }
    }
    return scanners;
}

void add_from(const std::filesystem::path& file, sim::MaterialLibrary& library) {
    for (sim::MaterialOptics& material : sim::load_materials(file))
        library.add(std::move(material));
}

/// Reads each file once, whoever plays it and how fast.
class Reader {
  public:
    explicit Reader(bool strict) : strict_(strict) {}

    PlayedPoses read(const PoseSource& source) {
        PlayedPoses& poses = read_[{source.file, source.format, source.times}];
        if (!poses) {
            ReadTrajectory read = read_trajectory(source);
            if (strict_ && !read.warnings.empty()) throw sim::LoadError(std::move(read.warnings));
            std::ranges::move(read.warnings, std::back_inserter(warnings));
            poses = std::move(read.poses);
        }
        check_speed(source, *poses);
        return poses;
    }

    std::vector<std::string> warnings;

  private:
    using File = std::tuple<std::filesystem::path, sim::TrajectoryFormat, std::filesystem::path>;

    bool strict_;
    std::map<File, PlayedPoses> read_;
};

bool is_played(const RobotConfig& robot, const PlayedSources& played) {
    const auto found = played.find(robot.name);
    return found != played.end() && found->second == *robot.poses;
}

}  // namespace

sim::LoadError named_at(const std::string& place, const sim::LoadError& error) {
    std::vector<std::string> faults;
    for (const std::string& fault : error.faults())
        faults.push_back(place + fault);
    return sim::LoadError(std::move(faults));
}

// Where no sensor sees light, nobody asks what a material is, and an unknown one is no warning.
sim::SceneOptions scene_options(const Config& config, const sim::SharedMaterials& materials) {
    sim::SceneOptions options{.sdf = {.geometry = config.geometry,
                                      .xacro = config.xacro,
                                      .model_folders = stock_models(),
                                      .strict = config.strict},
                              .map = config.map,
                              .materials = config.any_sees_light() ? materials : nullptr};
    apply(config.limits, options);
    return options;
}

sim::LoadedScene load_world(const Config& config, const sim::SharedMaterials& materials,
                            const std::stop_token& stop) {
    sim::LoadedScene loaded = load_scene(config, materials, stop);
    std::vector<std::string> faults;
    for (const RobotConfig& robot : config.robots) {
        if (robot.body.empty() || moves(*loaded.scene, robot.body)) continue;
        faults.push_back(config.place_of("robots." + robot.name + ".body") + config.scene.string() +
                         " has no movable model \"" + robot.body + "\"; movable models are " +
                         movable_models(*loaded.scene));
    }
    if (!faults.empty()) throw sim::LoadError(std::move(faults));
    return loaded;
}

std::optional<Scenario> load_scenario(const Config& config) {
    if (config.scenario.empty()) return std::nullopt;
    try {
        return load_scenario(config.scenario, scanners_of(config));
    } catch (const sim::LoadError& error) {
        throw named_at(config.place_of("scenario"), error);
    }
}

LoadedMaterials load_materials(const Config& config) {
    sim::MaterialLibrary library;
    std::vector<std::string> warnings;
    if (const auto stock = stock_materials()) {
        add_from(*stock, library);
    } else {
        warnings.push_back(stock.error().why + "; without it surfaces are matt and white unless " +
                           "the configuration names a file under materials");
        if (config.strict) throw sim::LoadError(std::move(warnings));
    }
    if (!config.materials.empty()) {
        try {
            add_from(config.materials, library);
        } catch (const sim::LoadError& error) {
            throw named_at(config.place_of("materials"), error);
        }
    }
    return {std::make_shared<const sim::MaterialLibrary>(std::move(library)), std::move(warnings)};
}

std::string summary_of(const sim::MaterialLibrary& library) {
    const std::size_t numbers = library.numbers();
    const double share = numbers == 0 ? 0.0
                                      : 100.0 * static_cast<double>(library.assumed()) /
                                            static_cast<double>(numbers);
    return std::to_string(library.materials().size()) + " with " + std::to_string(numbers) +
           " parameters, " + std::to_string(std::lround(share)) +
           " % of them assumed (not measured)";
}

LoadedTrajectories load_trajectories(const Config& config, const PlayedSources& played,
                                     const std::stop_token& stop) {
    LoadedTrajectories loaded;
    Reader reader(config.strict);
    std::vector<std::string> faults;
    for (const RobotConfig& robot : config.robots) {
        if (!robot.poses || robot.poses->kind != PoseSource::Kind::file) continue;
        if (is_played(robot, played)) continue;
        if (stop.stop_requested()) throw sim::LoadError({"scipd ends"});
        try {
            loaded.poses[robot.name] = reader.read(*robot.poses);
        } catch (const sim::LoadError& error) {
            const std::string place = config.place_of("robots." + robot.name + ".poses");
            const sim::LoadError placed = named_at(place, error);
            std::ranges::copy(placed.faults(), std::back_inserter(faults));
        }
    }
    if (!faults.empty()) throw sim::LoadError(std::move(faults));
    loaded.warnings = std::move(reader.warnings);
    return loaded;
}

}  // namespace scipd::daemon
