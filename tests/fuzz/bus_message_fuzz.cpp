// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a message of a bus, its type in the first line: what is understood is finite, and
// nothing throws or reads beyond the end.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <variant>

#include "daemon/bridges/frame_tree.h"
#include "daemon/bridges/gz_message.h"
#include "daemon/bridges/ros_cdr.h"
#include "daemon/bridges/ros_json.h"
#include "sim/world/reach.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const Heard& heard) {
    FrameTree tree;
    for (const HeardPose& pose : heard.poses) {
        require(scipd::sim::plausible_position(pose.parent_from_child.translation_m));
        require(std::abs(glm::length(pose.parent_from_child.rotation) - 1.0) < 1e-9);
        if (pose.velocity)
            require(std::isfinite(pose.velocity->linear_mps.x + pose.velocity->angular_radps.z));
        tree.put(pose, heard.for_good);
    }
    for (const HeardPose& pose : heard.poses)
        (void)tree.find(heard.poses.front().parent, pose.child);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view all{reinterpret_cast<const char*>(data), size};
    const auto end = all.find('\n');
    if (end == all.npos) return 0;
    const auto [type, bytes] = std::pair(all.substr(0, end), all.substr(end + 1));
    if (const auto heard = read_ros_message(type, bytes)) check(*heard);
    if (const auto heard = read_gz_message(type, bytes)) check(*heard);
    if (const auto said = read_rosbridge(bytes)) {
        if (const auto* const published = std::get_if<RosbridgePublish>(&*said))
            check(published->heard);
    }
    return 0;
}
