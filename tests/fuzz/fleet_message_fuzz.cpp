// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a message of a broker, its topic in the first line: what is understood can be said
// again and means the same, and nothing throws.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/fleet/kept_messages.h"
#include "daemon/fleet/model_message.h"
#include "daemon/fleet/pose_frame.h"
#include "daemon/fleet/vda5050.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

void check_notes(std::string_view text) {
    if (const auto note = parse_daemon_note(text))
        require(parse_daemon_note(text_of(*note)).has_value());
    if (const auto note = parse_scene_note(text))
        require(parse_scene_note(text_of(*note)).has_value());
}

void check_poses(std::string_view text) {
    require(sender_of(text).size() <= text.size());
    for (const auto& line : poses_in(text)) {
        if (line.model.empty() && line.robot.empty()) continue;
        std::string frame;
        append_line(frame, line);
        const auto again = poses_in(frame);
        // Written out with all its digits it may be longer than a line may be.
        require(again.size() == 1 || frame.size() > 4096);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view all{reinterpret_cast<const char*>(data), size};
    const auto end = all.find('\n');
    const std::string_view text = end == all.npos ? std::string_view{} : all.substr(end + 1);
    const Topics topics("hall");
    if (const auto topic = topics.read(all.substr(0, end))) {
        require(topics.read(topics.of(topic->kind, topic->name)) == topic);
        KeptMessages kept;
        kept.take(*topic, text);
        if (const auto edit = parse_model_message(topic->name, std::string(text))) {
            if (const auto* add = std::get_if<AddModel>(&*edit))
                require(parse_model_message(topic->name, text_of(*add)).has_value());
        }
    }
    check_notes(text);
    check_poses(text);
    (void)parse_vda5050_state(text);
    if (const auto step = parse_step(text)) {
        require(parse_step(step_head(step->number, step->time, step->from)).has_value());
        require(acknowledged(acknowledgement(*step), step->from) == step->number);
    }
    return 0;
}
