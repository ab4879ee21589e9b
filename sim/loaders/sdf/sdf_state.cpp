// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_state.h"

#include <algorithm>
#include <optional>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

std::optional<Pose> pose_of(const XMLElement& element) {
    const auto* pose = element.FirstChildElement("pose");
    // In Gazebo Classic, no pose means the origin.
    if (pose == nullptr || pose->GetText() == nullptr) return Pose{};
    const auto n = parse_numbers(pose->GetText(), 6);
    if (!n) return std::nullopt;
    return pose_from_rpy({(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]});
}

/// Gazebo Classic ignores a scale below 0 and keeps the one that it has. One of 0 would leave
/// nothing to see.
std::optional<glm::dvec3> scale_of(const XMLElement& element) {
    const auto* scale = element.FirstChildElement("scale");
    if (scale == nullptr) return glm::dvec3{1.0};
    const auto n = parse_numbers(text_of(scale), 3);
    if (!n || std::ranges::count(*n, 0.0) > 0) return std::nullopt;
    if (std::ranges::min(*n) < 0.0) return glm::dvec3{1.0};
    return glm::dvec3{(*n)[0], (*n)[1], (*n)[2]};
}

class StateReader {
  public:
    StateReader(const std::filesystem::path& file, SceneDraft& draft)
        : file_(file), draft_(draft) {}

    SdfState read(const XMLElement& state) {
        read_parts(state, "");
        for (const XMLElement& list : Children(state, "deletions")) {
            for (const XMLElement& name : Children(list, "name")) {
                if (name.GetText() != nullptr) state_.deleted.insert(name.GetText());
            }
        }
        return std::move(state_);
    }

  private:
    void read_parts(const XMLElement& outer, const std::string& prefix) {
        for (const XMLElement& part : Children(outer)) {
            const std::string_view kind = part.Name();
            const char* name = part.Attribute("name");
            if ((kind != "model" && kind != "link") || name == nullptr) continue;
            add(part, prefix + name);
            if (kind == "model") read_parts(part, prefix + name + "::");
        }
    }

    void add(const XMLElement& part, const std::string& name) {
        const auto pose = pose_of(part);
        const auto scale = scale_of(part);
        if (pose && scale) {
            state_.entries.insert({name, {*pose, *scale, part.GetLineNum()}});
            return;
        }
        draft_.warn(file_.string() + ':' + std::to_string(part.GetLineNum()) + ": the <state> of " +
                    name + " has a " + (pose ? "scale" : "pose") +
                    " that is not a row of finite numbers" + (pose ? " other than 0" : "") +
                    "; its own pose and scale stay");
    }

    const std::filesystem::path& file_;
    SceneDraft& draft_;
    SdfState state_;
};

}  // namespace

const SdfState::Entry* SdfState::use(const std::string& name) {
    const auto found = entries.find(name);
    if (found == entries.end()) return nullptr;
    found->second.is_used = true;
    return &found->second;
}

std::string SdfState::unused(const std::filesystem::path& file) const {
    const std::pair<const std::string, Entry>* first = nullptr;
    std::size_t count = 0;
    for (const auto& entry : entries) {
        if (entry.second.is_used) continue;
        ++count;
        if (first == nullptr || entry.second.line < first->second.line) first = &entry;
    }
    if (first == nullptr) return {};
    return file.string() + ':' + std::to_string(first->second.line) + ": <state> tells where " +
           quote(first->first) +
           (count > 1 ? " and " + std::to_string(count - 1) + " more lie" : " lies") +
           ", and the world has nothing of that name; ignored";
}

SdfState state_of(const XMLElement& world, const std::filesystem::path& file, SceneDraft& draft) {
    const auto* state = world.FirstChildElement("state");
    return state == nullptr ? SdfState{} : StateReader{file, draft}.read(*state);
}

}  // namespace scipd::sim
