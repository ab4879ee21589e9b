// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_world.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/demo_world.h"
#include "daemon/config/world_options.h"

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

}  // namespace scipd::daemon
