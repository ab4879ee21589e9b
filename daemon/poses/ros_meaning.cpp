// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/frame_tree.h"
#include "daemon/bridges/name_hint.h"
#include "daemon/poses/heard_meaning.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

// ROS Enhancement Proposal 105, "Coordinate Frames for Mobile Platforms".
constexpr const char* usual_parent = "odom";
constexpr const char* usual_child = "base_link";

class RosMeaning : public HeardMeaning {
  public:
    explicit RosMeaning(const RosFrames& frames)
        : chosen_(!frames.parent.empty() || !frames.child.empty()),
          parent_(frames.parent.empty() ? usual_parent : frames.parent),
          child_(frames.child.empty() ? usual_child : frames.child) {}

    Said take(const Heard& message, const std::string& robot, const World& /*world*/) override {
        if (message.clock) return {.until = message.clock, .lines = {}};
        if (!chosen_ && message.type != "tf2_msgs/TFMessage") return directly(message, robot);
        for (HeardPose pose : message.poses) {
            // A pose of no frame is the robot's.
            if (pose.child.empty()) pose.child = child_;
            tree_.put(pose, message.for_good);
        }
        looked_ = true;
        return by_frames(robot);
    }

    [[nodiscard]] std::vector<std::string> troubles(const std::string& /*robot*/,
                                                    const World& /*world*/) const override {
        if (!looked_ || found_) return {};
        const auto names = tree_.names();
        for (const std::string& frame : {parent_, child_}) {
            if (!names.contains(frame))
                return {"there is no frame " + sim::quote(frame) +
                        name_hint(frame, names, "frames")};
        }
        return {"no transforms lead from " + sim::quote(parent_) + " to " + sim::quote(child_)};
    }

  private:
    static Said directly(const Heard& message, const std::string& robot) {
        Said said;
        for (const HeardPose& pose : message.poses) {
            said.lines.push_back({.robot = robot,
                                  .time = pose.time,
                                  .pose = pose.parent_from_child,
                                  .velocity = pose.velocity});
            said.until = pose.time;
        }
        return said;
    }

    /// Transforms of other frames may say nothing new of it.
    Said by_frames(const std::string& robot) {
        const auto found = tree_.find(parent_, child_);
        found_ = found.has_value();
        if (!found) return {};
        const bool same_time = told_ && told_->time == found->time;
        if (same_time && (found->time || told_->parent_from_child == found->parent_from_child))
            return {};
        told_ = found;
        return {.until = found->time,
                .lines = {{.robot = robot, .time = found->time, .pose = found->parent_from_child}}};
    }

    bool chosen_;
    std::string parent_;
    std::string child_;
    FrameTree tree_;
    bool looked_ = false;
    bool found_ = false;
    std::optional<FrameTree::Found> told_;
};

}  // namespace

std::unique_ptr<HeardMeaning> make_ros_meaning(const RosFrames& frames) {
    return std::make_unique<RosMeaning>(frames);
}

}  // namespace scipd::daemon
