// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/config_changes.h"

#include <map>
#include <vector>

namespace scipd::daemon {
namespace {

using Names = std::vector<std::string>;
using Sensors = std::map<std::string, SensorConfig>;

Sensors sensors_of(const Config& config) {
    Sensors sensors;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors)
            sensors.emplace(sensor_name(robot.name, sensor.name), sensor);
    }
    return sensors;
}

std::map<std::string, RobotConfig> robots_of(const Config& config) {
    std::map<std::string, RobotConfig> robots;
    for (RobotConfig robot : config.robots) {
        robot.sensors.clear();
        robots.emplace(robot.name, robot);
    }
    return robots;
}

template <typename Things>
Names only_in(const Things& these, const Things& others) {
    Names names;
    for (const auto& [name, thing] : these) {
        if (!others.contains(name)) names.push_back(name);
    }
    return names;
}

template <typename Things>
void add_changed(const Things& was, const Things& is, Names& names) {
    for (const auto& [name, thing] : was) {
        const auto now = is.find(name);
        if (now != is.end() && !(now->second == thing)) names.push_back(name);
    }
}

void add_changed_keys(const Config& was, const Config& is, Names& names) {
    const auto add = [&](bool same, const char* key) {
        if (!same) names.emplace_back(key);
    };
    add(was.scene == is.scene, "scene");
    add(was.geometry == is.geometry, "geometry");
    add(was.xacro == is.xacro, "xacro");
    add(was.map == is.map, "map");
    add(was.materials == is.materials, "materials");
    add(was.media == is.media, "media");
    add(was.scenario == is.scenario, "scenario");
    add(was.seed == is.seed, "seed");
    add(was.limits == is.limits && was.client_limits.values == is.client_limits.values, "limits");
    add(was.allow == is.allow, "allow");
}

void add_list(const char* what, const Names& names, std::string& text) {
    if (names.empty()) return;
    text += text.empty() ? "" : "; ";
    text += what;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? ": " : ", ") + names[i];
}

}  // namespace

std::string changes_between(const Config& was, const Config& is) {
    const Sensors before = sensors_of(was);
    const Sensors now = sensors_of(is);
    Names changed;
    add_changed_keys(was, is, changed);
    add_changed(robots_of(was), robots_of(is), changed);
    add_changed(before, now, changed);
    std::string text;
    add_list("new", only_in(now, before), text);
    add_list("gone", only_in(before, now), text);
    add_list("changed", changed, text);
    return text.empty() ? "nothing changed" : text;
}

}  // namespace scipd::daemon
