// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/robots.h"

#include <algorithm>

namespace scipd::tools {

std::vector<std::string> robots(ControlClient& client) {
    std::vector<std::string> names;
    for (const auto& sensor : client.get("/sensors")) {
        const auto name = sensor.value("name", std::string());
        const std::string robot = name.substr(0, name.find('/'));
        if (std::ranges::find(names, robot) == names.end()) names.push_back(robot);
    }
    return names;
}

std::string choose_robot(ControlClient& client, const std::string& wanted) {
    if (!wanted.empty()) return wanted;
    const auto names = robots(client);
    if (names.size() == 1) return names.front();
    if (names.empty()) throw ControlError(0, "scipd has no robot with a sensor: name one");
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    throw ControlError(0, "there are several robots; name one of " + list);
}

std::string pose_path(const std::string& robot) {
    return "/robots/" + path_segment(robot) + "/pose";
}

}  // namespace scipd::tools
