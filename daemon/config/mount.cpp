// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/mount.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "daemon/config/poses.h"
#include "daemon/config/values.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 4> mount_keys{"link", "sensor", "xyz", "rpy"};

sim::Expected<std::string> parse_named_place(std::string_view text) {
    if (text.empty()) return sim::refuse("must name a place, such as MODEL::LINK");
    return std::string{text};
}

}  // namespace

void read_mount(const sim::YamlSection& section, SensorConfig& sensor, sim::YamlFaults& faults,
                std::map<std::string, std::string>& places) {
    const sim::YamlField* field = section.find("mount");
    if (!field) return;
    const sim::YamlSection mount{*field, mount_keys, faults,
                                 "mount: {xyz: [0, 0, 0.3], rpy: [0, 0, 0]}"};
    const sim::Pose pose = pose_in(mount, faults);
    sensor.robot_from_sensor = pose;
    places[field->path] = faults.place(field->line, field->path);
    const bool on_sensor = mount.find("sensor") != nullptr;
    if (!on_sensor && !mount.find("link")) return;
    if (on_sensor && mount.find("link")) {
        faults.add(*field, "give link or sensor, not both");
    }
    NamedMount named{.kind = on_sensor ? MountKind::sensor : MountKind::link,
                     .frame_from_sensor = pose};
    mount.read(on_sensor ? "sensor" : "link", named.name, parse_named_place);
    sensor.mount = std::move(named);
}

sim::Expected<> take_mount(std::string_view text, SensorConfig& sensor) {
    const auto commas = std::ranges::count(text, ',');
    if (commas > 0 && commas != 5)
        return sim::refuse(
            "must be X,Y,Z,ROLL,PITCH,YAW or a name, not " + sim::quote(text) +
            (commas == 2 ? "; for X,Y,Z write " + std::string(text) + ",0,0,0" : ""));
    if (commas > 0)
        return parse_pose(text).map(
            [&](const sim::Pose& pose) { sensor.robot_from_sensor = pose; });
    return parse_named_place(text).map([&](const std::string& name) {
        sensor.mount = NamedMount{.kind = MountKind::any, .name = name};
    });
}

}  // namespace scipd::daemon
