// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/urdf_tree.h"

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t longest_shown_name = 200;

std::string link_of(const XMLElement& joint, const char* end) {
    const auto* named = joint.FirstChildElement(end);
    return named == nullptr ? "" : attribute(*named, "link");
}

std::string shown_name(const std::string& name) {
    return printable(name, longest_shown_name);
}

glm::dvec3 vector_in(const XMLElement& origin, const char* name, std::vector<std::string>& faults) {
    const char* text = origin.Attribute(name);
    if (text == nullptr) return glm::dvec3{0.0};
    if (const auto n = parse_numbers(text, 3)) return glm::dvec3{(*n)[0], (*n)[1], (*n)[2]};
    faults.push_back(std::string{"its <origin "} + name + "='" +
                     printable(text, longest_shown_name) + "'> cannot be read");
    return glm::dvec3{0.0};
}

}  // namespace

Pose pose_of_origin(const XMLElement* origin, std::vector<std::string>& faults) {
    if (origin == nullptr) return {};
    const glm::dvec3 xyz_m = vector_in(*origin, "xyz", faults);
    return pose_from_rpy(xyz_m, vector_in(*origin, "rpy", faults));
}

UrdfTree::UrdfTree(const XMLElement& robot, const std::set<std::string>& links,
                   const Wrong& wrong) {
    for (const XMLElement& joint : Children(robot, "joint")) {
        if (const auto fault = fault_of(joint, links); !fault.empty()) {
            wrong(joint, fault + "; left out");
            continue;
        }
        std::vector<std::string> faults;
        const Pose pose = pose_of_origin(joint.FirstChildElement("origin"), faults);
        if (!faults.empty()) wrong(joint, faults.front() + "; what hangs on it is left out");
        above_[link_of(joint, "child")] = {link_of(joint, "parent"), pose, !faults.empty()};
    }
}

std::string UrdfTree::fault_of(const XMLElement& joint, const std::set<std::string>& links) const {
    for (const char* end : {"parent", "child"}) {
        const std::string link = link_of(joint, end);
        if (link.empty()) return std::string{"has no <"} + end + " link='..'>";
        if (!links.contains(link)) {
            return std::string{"its <"} + end + "> " + shown_name(link) + " is no link";
        }
    }
    const std::string child = link_of(joint, "child");
    if (above_.contains(child)) return "link " + shown_name(child) + " hangs on another joint";
    std::string top = link_of(joint, "parent");
    for (const Hung* hung = above(top); hung != nullptr && top != child; hung = above(top))
        top = hung->parent;
    return top == child ? "its parent hangs on its child" : "";
}

bool UrdfTree::is_lost(std::string link) const {
    for (const Hung* hung = above(link); hung != nullptr; hung = above(link)) {
        if (hung->is_lost) return true;
        link = hung->parent;
    }
    return false;
}

const UrdfTree::Hung* UrdfTree::above(const std::string& link) const {
    const auto found = above_.find(link);
    return found == above_.end() ? nullptr : &found->second;
}

}  // namespace scipd::sim
