// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "daemon/bridges/name_hint.h"
#include "daemon/poses/heard_meaning.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using Poses = std::vector<HeardPose>;

// A rest that is longer ends in a jump anyway (sim::PosePolicy::longest_gap).
constexpr sim::Time longest_rest = std::chrono::milliseconds(500);

const HeardPose* find(const Poses& poses, std::string_view name) {
    const auto found = std::ranges::find(poses, name, &HeardPose::child);
    return found == poses.end() ? nullptr : &*found;
}

/// MODEL::LINK, where the message has both apart: dynamic_pose/info has all models, and then all
/// links with their places in their models. Gazebo numbers the links of a model right after it.
std::optional<HeardPose> find_link(const Poses& poses, std::string_view name) {
    const auto colons = name.rfind("::");
    if (colons == name.npos) return std::nullopt;
    const HeardPose* const model = find(poses, name.substr(0, colons));
    if (model == nullptr) return std::nullopt;
    const HeardPose* link = nullptr;
    for (const HeardPose& pose : poses) {
        const bool is_behind = pose.child == name.substr(colons + 2) && pose.id > model->id;
        if (is_behind && (link == nullptr || pose.id < link->id)) link = &pose;
    }
    if (link == nullptr) return std::nullopt;
    HeardPose found = *model;
    found.parent_from_child = model->parent_from_child * link->parent_from_child;
    return found;
}

class GzMeaning : public HeardMeaning {
  public:
    explicit GzMeaning(std::string called) : called_(std::move(called)) {}

    void move_models(bool yes) override { moves_models_ = yes; }

    Said take(const Heard& message, const std::string& robot, const World& world) override {
        if (message.clock) return {.until = message.clock, .lines = {}};
        Said said;
        if (!message.poses.empty()) said.until = message.poses.front().time;
        const std::string wanted = name_of(robot, world);
        place_robot(message.poses, robot, wanted, said);
        if (moves_models_) place_models(message.poses, wanted, world, said);
        note_names(message.poses);
        return said;
    }

    [[nodiscard]] std::vector<std::string> troubles(const std::string& robot,
                                                    const World& world) const override {
        if (!looked_) return {};
        std::vector<std::string> troubles;
        const std::string wanted = name_of(robot, world);
        if (!found_robot_)
            troubles.push_back("Gazebo names no " + sim::quote(wanted) +
                               name_hint(wanted, names_, "names"));
        if (!moves_models_ || !world.names()) return troubles;
        constexpr std::size_t most = 10;
        for (const sim::Model& model : world.names()->models) {
            if (!model.movable || names_.contains(model.name) || model.name == wanted) continue;
            if (is_body(model.name, world) || troubles.size() >= most) continue;
            troubles.push_back("Gazebo does not move model " + sim::quote(model.name) +
                               name_hint(model.name, names_, "names"));
        }
        return troubles;
    }

  private:
    [[nodiscard]] std::string name_of(const std::string& robot, const World& world) const {
        if (!called_.empty()) return called_;
        const auto found = world.robots().find(robot);
        const bool has_body = found != world.robots().end() && !found->second.start.body.empty();
        return has_body ? found->second.start.body : robot;
    }

    void place_robot(const Poses& poses, const std::string& robot, const std::string& wanted,
                     Said& said) {
        std::optional<HeardPose> found;
        if (const HeardPose* const pose = find(poses, wanted))
            found = *pose;
        else if (poses.size() == 1 && poses[0].child.empty())
            found = poses[0];
        else
            found = find_link(poses, wanted);
        if (!found) return;
        found_robot_ = true;
        said.lines.push_back(
            {.robot = robot, .time = found->time, .pose = found->parent_from_child});
    }

    static bool is_body(const std::string& model, const World& world) {
        return std::ranges::any_of(
            world.robots(), [&](const auto& robot) { return robot.second.start.body == model; });
    }

    /// A link may have the name of a model; models come first.
    void place_models(const Poses& poses, const std::string& wanted, const World& world,
                      Said& said) {
        std::set<std::string_view> seen;
        for (const HeardPose& pose : poses) {
            if (!seen.insert(pose.child).second || pose.child == wanted) continue;
            const sim::PoseTrack* const track = world.model(pose.child);
            if (track == nullptr || is_body(pose.child, world)) continue;
            place_model(pose, *track, said);
        }
    }

    /// One that rests is placed again only when it has moved, and then first where it rested until
    /// the message before: it did not creep there meanwhile.
    void place_model(const HeardPose& pose, const sim::PoseTrack& track, Said& said) {
        if (pose.time && track.last() == pose.parent_from_child) {
            rested_until_[pose.child] = *pose.time;
            return;
        }
        const auto rested = rested_until_.find(pose.child);
        if (rested != rested_until_.end()) {
            if (pose.time && rested->second < *pose.time &&
                *pose.time - rested->second < longest_rest)
                said.lines.push_back(
                    {.model = pose.child, .time = rested->second, .pose = track.last()});
            rested_until_.erase(rested);
        }
        said.lines.push_back(
            {.model = pose.child, .time = pose.time, .pose = pose.parent_from_child});
    }

    void note_names(const Poses& poses) {
        constexpr std::size_t most_names = 10'000;
        looked_ = true;
        for (const HeardPose& pose : poses) {
            if (names_.size() < most_names && !pose.child.empty()) names_.insert(pose.child);
        }
    }

    const std::string called_;
    bool moves_models_ = false;
    bool looked_ = false;
    bool found_robot_ = false;
    std::set<std::string> names_;
    std::map<std::string, sim::Time> rested_until_;  ///< by the sender's clock
};

}  // namespace

std::unique_ptr<HeardMeaning> make_gz_meaning(const std::string& called) {
    return std::make_unique<GzMeaning>(called);
}

}  // namespace scipd::daemon
