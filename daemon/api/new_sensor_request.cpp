// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/new_sensor_request.h"

#include <nlohmann/json.hpp>

#include "daemon/config/values.h"
#include "sim/loaders/poses/small_json.h"

namespace scipd::daemon {

using sim::Expected;
using sim::refuse;

Expected<AddedSensor> parse_new_sensor(const std::string& body) {
    auto parsed = sim::parse_ordered_json(body);
    if (!parsed)
        return refuse(parsed.error().field, "the body must be JSON: " + parsed.error().why);
    if (!parsed->is_object() || !parsed->contains("name") || !(*parsed)["name"].is_string()) {
        return refuse("name", R"(the body must be an object such as {"name":"robot/rear",)"
                              R"("model":"UST-10LX","tcp":"127.0.0.1:0"})");
    }
    const std::string name = (*parsed)["name"];
    const auto slash = name.find('/');
    const auto robot = parse_name(name.substr(0, slash));
    const auto sensor = parse_name(slash == name.npos ? "" : name.substr(slash + 1));
    if (slash == name.npos) return refuse("name", "must be ROBOT/SENSOR");
    for (const auto& part : {robot, sensor})
        if (!part) return refuse("name", part.error().why);
    AddedSensor added{.robot = *robot, .name = *sensor};
    if (parsed->contains("pose")) added.robot_pose = (*parsed)["pose"].dump();
    parsed->erase("name");
    parsed->erase("pose");
    added.keys = parsed->dump();
    return added;
}

Expected<> check_files(const AddedSensor& sensor) {
    const auto keys = nlohmann::json::parse(sensor.keys);
    if (keys.contains("replay"))
        return refuse("replay", "names a file of this machine: write it into the configuration");
    if (keys.contains("pty") && keys["pty"] != "auto" && keys["pty"] != "none") {
        return refuse("pty",
                      "must be auto, which makes a link in the run directory, or none; a path is "
                      "for the configuration");
    }
    return {};
}

}  // namespace scipd::daemon
