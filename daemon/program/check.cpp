// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "daemon/config/config_file.h"
#include "daemon/plan/load_materials.h"
#include "daemon/plan/load_scenario.h"
#include "daemon/plan/load_trajectories.h"
#include "daemon/plan/load_world.h"
#include "daemon/plan/mounting.h"
#include "daemon/plan/notices.h"
#include "daemon/plan/unlikely_places.h"
#include "daemon/program/check_file.h"
#include "daemon/world/backend_choice.h"
#include "sim/backends/registry.h"

namespace scipd::daemon {
namespace {

using Sentences = std::vector<std::string>;

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
    if (!options.overrides.scenario.empty())
        throw sim::LoadError({file.string() + ": --scenario goes with a configuration"});
    return check_file(*kind, file, options.overrides);
}

}  // namespace scipd::daemon
