// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/world_view.h"

#include <cstddef>
#include <utility>

#include "daemon/api/documents.h"
#include "daemon/api/object_text.h"

namespace scipd::daemon {
namespace {

/// Appends `"NAME":{pose}` to the members of an object.
void append_member(std::string& members, const std::string& name, const sim::Pose& pose) {
    if (!members.empty()) members += ',';
    members.append(text_of(name)).append(1, ':');
    append_pose(members, pose);
}

bool changes(std::optional<sim::Pose>& told, const sim::Pose& now) {
    return std::exchange(told, now) != now;
}

}  // namespace

std::optional<std::string> WorldMotion::news(const WorldView& now) {
    if (version_ == now.version) return std::nullopt;
    version_ = now.version;
    models_.assign(now.scene->models.size(), std::nullopt);
    robots_.assign(now.robots.size(), std::nullopt);
    return text_of(Json{{"scene", version_}});
}

std::optional<std::string> WorldMotion::moved(const WorldView& now) {
    std::string robots;
    std::string models;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        const RobotView& robot = now.robots[i];
        if (changes(robots_[i], robot.pose)) append_member(robots, robot.name, robot.pose);
    }
    for (std::size_t id = 0; id < models_.size(); ++id) {
        const sim::Model& model = now.scene->models[id];
        if (model.movable && changes(models_[id], now.models[id]))
            append_member(models, model.name, now.models[id]);
    }
    if (robots.empty() && models.empty()) return std::nullopt;
    std::string text = R"({"time_s":)";
    append_number(text, seconds(now.time));
    text.append(R"(,"robots":{)").append(robots);
    return text.append(R"(},"models":{)").append(models).append("}}");
}

}  // namespace scipd::daemon
