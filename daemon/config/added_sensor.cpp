// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/added_sensor.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "daemon/config/config_file.h"
#include "daemon/config/saved_config.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

/// What is running, as a text of which a part can be changed.
YAML::Node document_of(const Config& now) {
    return YAML::Load(saved_config(now, now.scene.string()));
}

std::string text_of(const YAML::Node& document) {
    YAML::Emitter out;
    out << document;
    return std::string(out.c_str()) + "\n";
}

/// "FILE:LINE: robots.R.sensors.S.tcp: why" is "tcp: why" to whoever has said the keys alone.
std::string without_place(const std::string& fault, const std::string& robot,
                          const std::string& sensor) {
    const std::string path = "robots." + robot;
    const auto begin = fault.find(path);
    if (begin == fault.npos) return fault;
    const std::string rest = fault.substr(begin + path.size());
    for (const std::string& known : {".sensors." + sensor + ".", ".sensors." + sensor + ": ",
                                     std::string("."), std::string(": ")}) {
        if (rest.starts_with(known)) return rest.substr(known.size());
    }
    return fault;
}

Config read(const std::string& text, const Config& now, const AddedSensor& added) {
    try {
        return parse_config(text, now.file.empty() ? "what runs" : now.file);
    } catch (const sim::LoadError& error) {
        std::vector<std::string> faults;
        std::ranges::transform(error.faults(), std::back_inserter(faults),
                               [&](const std::string& fault) {
                                   return without_place(fault, added.robot, added.name);
                               });
        throw sim::LoadError(std::move(faults));
    }
}

template <class Named>
auto named(std::vector<Named>& list, const std::string& name) {
    return std::ranges::find(list, name, &Named::name);
}

}  // namespace

// What runs stays the values that it is: of the text only what is new is taken.
Config with_sensor(const Config& now, const AddedSensor& added) {
    YAML::Node document = document_of(now);
    YAML::Node said = document["robots"][added.robot];
    if (added.robot_pose) said["pose"] = YAML::Load(*added.robot_pose);
    said["sensors"][added.name] = YAML::Load(added.keys);
    Config next = now;
    next.document = text_of(document);
    Config whole = read(next.document, now, added);
    RobotConfig robot = *named(whole.robots, added.robot);
    SensorConfig sensor = *named(robot.sensors, added.name);
    const auto there = named(next.robots, added.robot);
    if (there != next.robots.end()) {
        there->sensors.push_back(std::move(sensor));
    } else {
        next.robots.push_back(std::move(robot));
    }
    return next;
}

Config without_sensor(const Config& now, const std::string& robot, const std::string& sensor) {
    YAML::Node document = document_of(now);
    Config next = now;
    const auto carrier = named(next.robots, robot);
    carrier->sensors.erase(named(carrier->sensors, sensor));
    document["robots"][robot]["sensors"].remove(sensor);
    if (carrier->sensors.empty()) {
        next.robots.erase(carrier);
        document["robots"].remove(robot);
    }
    next.document = text_of(document);
    return next;
}

}  // namespace scipd::daemon
