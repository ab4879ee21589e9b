// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_tapes.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "daemon/plan/read_tape.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

/// Says of itself what the recorded one said.
void take_identity(const sim::ScannerIdentity& identity, Model& model) {
    protocol::DeviceProfile& profile = model.profile;
    for (const auto& [key, target] :
         {std::pair{"VEND", &profile.vendor}, std::pair{"PROD", &profile.product},
          std::pair{"FIRM", &profile.firmware}, std::pair{"PROT", &profile.protocol}}) {
        if (auto said = value_of(identity.version, key); !said.empty()) *target = std::move(said);
    }
    if (identity.serial.empty()) return;
    profile.serial = identity.serial;
    model.own_serial = true;
}

}  // namespace

LoadedTapes load_tapes(Config& config, const std::stop_token& stop) {
    LoadedTapes loaded;
    std::vector<std::string> faults;
    for (RobotConfig& robot : config.robots) {
        for (SensorConfig& sensor : robot.sensors) {
            if (!sensor.replay) continue;
            const std::string name = sensor_name(robot.name, sensor.name);
            try {
                if (sensor.replay->begins && config.clock != ClockKind::poses)
                    throw sim::LoadError({"begins_s is a stamp of poses, and needs clock: poses"});
                if (sensor.replay->finds_model) {
                    RecordedScanner scanner = recorded_scanner(*sensor.replay);
                    take_identity(scanner.identity, scanner.model);
                    sensor.model = std::move(scanner.model);
                }
                loaded.tapes[name] = read_tape(*sensor.replay, sensor.model, loaded.warnings, stop);
            } catch (const sim::LoadError& error) {
                std::ranges::transform(error.faults(), std::back_inserter(faults),
                                       [&](const std::string& why) { return name + ": " + why; });
            }
        }
    }
    if (config.strict) std::ranges::copy(loaded.warnings, std::back_inserter(faults));
    if (!faults.empty()) throw sim::LoadError(std::move(faults));
    return loaded;
}

}  // namespace scipd::daemon
