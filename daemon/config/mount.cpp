// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/mount.h"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "daemon/config/numbers.h"
#include "daemon/config/values.h"

namespace scipd::daemon {
namespace {

constexpr std::array<std::string_view, 4> mount_keys{"link", "sensor", "xyz", "rpy"};

std::string parse_frame(const std::string& text) {
    if (text.empty()) throw std::invalid_argument("must name a place, such as MODEL::LINK");
    return text;
}

}  // namespace

void read_mount(const Section& section, SensorConfig& sensor, SensorContext& context) {
    const Field* field = section.find("mount");
    if (!field) return;
    const Section mount{*field, {mount_keys, {}}, context.faults};
    glm::dvec3 xyz_m{0.0};
    glm::dvec3 rpy_rad{0.0};
    mount.read_vector("xyz", xyz_m, parse_metres);
    mount.read_vector("rpy", rpy_rad, parse_radians);
    const sim::Pose pose = sim::pose_from_rpy(xyz_m, rpy_rad);
    sensor.robot_from_sensor = pose;
    const bool on_sensor = mount.find("sensor") != nullptr;
    if (!on_sensor && !mount.find("link")) return;
    if (on_sensor && mount.find("link")) {
        context.faults.add(*field, "give link or sensor, not both");
    }
    NamedMount named{.kind = on_sensor ? MountKind::sensor : MountKind::link,
                     .frame_from_sensor = pose};
    mount.read(on_sensor ? "sensor" : "link", named.name, parse_frame);
    sensor.mount = std::move(named);
    context.places[field->path] = context.faults.place(field->line, field->path);
}

void take_mount(std::string_view text, SensorConfig& sensor) {
    if (text.find(',') != text.npos) {
        sensor.robot_from_sensor = parse_pose(text);
    } else {
        sensor.mount = NamedMount{.kind = MountKind::any, .name = parse_frame(std::string{text})};
    }
}

}  // namespace scipd::daemon
