// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_ignored.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include <ignition/math/MassMatrix3.hh>
#include <tinyxml2.h>

#include "sim/loaders/sdf/sdf_names.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::array joint_types{"ball",     "continuous", "fixed", "gearbox",  "prismatic",
                                 "revolute", "revolute2",  "screw", "universal"};
constexpr std::array<std::string_view, 6> joint_types_of_robots{
    "continuous", "fixed", "floating", "planar", "prismatic", "revolute"};

bool is_called(const XMLElement& element, std::string_view name) {
    return element.Name() == name;
}

/// The number of a child; `otherwise`, SDF's default, if there is no such child.
double number_in(const XMLElement* element, const char* name, double otherwise) {
    const auto* child = element == nullptr ? nullptr : element->FirstChildElement(name);
    if (child == nullptr) return otherwise;
    // A text that is not a number counts as an impossible mass.
    return child->DoubleText(-1.0);
}

bool has_invalid_inertia(const XMLElement& link) {
    const auto* inertial = link.FirstChildElement("inertial");
    if (!is_called(link, "link") || inertial == nullptr) return false;
    const auto* inertia = inertial->FirstChildElement("inertia");
    const auto moment = [&](const char* name, double otherwise) {
        return number_in(inertia, name, otherwise);
    };
    const ignition::math::MassMatrix3d matrix{
        number_in(inertial, "mass", 1.0),
        {moment("ixx", 1.0), moment("iyy", 1.0), moment("izz", 1.0)},
        {moment("ixy", 0.0), moment("ixz", 0.0), moment("iyz", 0.0)}};
    return !matrix.IsValid();
}

bool has_script_without_uri(const XMLElement& visual) {
    const auto* material = visual.FirstChildElement("material");
    const auto* script = material == nullptr ? nullptr : material->FirstChildElement("script");
    if (script == nullptr) return false;
    const auto* uri = script->FirstChildElement("uri");
    return uri == nullptr || uri->GetText() == nullptr;
}

bool has_negative_friction(const XMLElement& element) {
    if (is_called(element, "mu") || is_called(element, "mu2")) return element.DoubleText(0.0) < 0.0;
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (has_negative_friction(*child)) return true;
    }
    return false;
}

bool has_slippery_surface(const XMLElement& collision) {
    const auto* surface = collision.FirstChildElement("surface");
    return surface != nullptr && has_negative_friction(*surface);
}

bool has_part(const XMLElement& model, const std::string& name) {
    for (const auto* child = model.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (own_name(*child) == name) return true;
    }
    return false;
}

/// Whether anything in `element` is relative to `name`.
bool refers_to(const XMLElement& element, const std::string& name) {
    for (const char* attribute : {"relative_to", "attached_to"}) {
        const char* value = element.Attribute(attribute);
        if (value != nullptr && value == name) return true;
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (refers_to(*child, name)) return true;
    }
    return false;
}

bool is_joint(const XMLElement& element) {
    const auto* model = element.Parent()->ToElement();
    return is_called(element, "joint") && model != nullptr && is_called(*model, "model");
}

bool joins_nothing(const XMLElement& joint) {
    if (!is_joint(joint)) return false;
    const auto* model = joint.Parent()->ToElement();
    // The link may come from the include, which is not read here.
    if (model->FirstChildElement("include") != nullptr) return false;
    // If something is relative to the joint, it matters, and the library reports what is wrong.
    if (refers_to(*model, own_name(joint))) return false;
    return std::ranges::any_of(std::array{"parent", "child"}, [&](const char* end) {
        const auto* named = joint.FirstChildElement(end);
        const char* text = named == nullptr ? nullptr : named->GetText();
        if (text == nullptr) return true;
        const std::string name = text;
        return name != "world" && name.find("::") == name.npos && !has_part(*model, name);
    });
}

bool is_of_no_type(const XMLElement& joint) {
    if (!is_joint(joint)) return false;
    const char* type = joint.Attribute("type");
    return type == nullptr ||
           std::ranges::find(joint_types, std::string_view{type}) == joint_types.end();
}

std::string_view type_of(const XMLElement& joint) {
    const char* type = joint.Attribute("type");
    return type == nullptr ? "" : type;
}

bool is_joint_of_robot(const XMLElement& element) {
    const auto* robot = element.Parent()->ToElement();
    return is_called(element, "joint") && robot != nullptr && is_called(*robot, "robot");
}

bool is_of_no_type_of_robots(const XMLElement& joint) {
    return is_joint_of_robot(joint) &&
           std::ranges::find(joint_types_of_robots, type_of(joint)) == joint_types_of_robots.end();
}

bool has_no_limit(const XMLElement& joint) {
    const auto type = type_of(joint);
    if (!is_joint_of_robot(joint) || (type != "revolute" && type != "prismatic")) return false;
    const auto* limit = joint.FirstChildElement("limit");
    double number = 0.0;
    return limit == nullptr ||
           limit->QueryDoubleAttribute("effort", &number) != tinyxml2::XML_SUCCESS ||
           limit->QueryDoubleAttribute("velocity", &number) != tinyxml2::XML_SUCCESS;
}

bool has_no_direction(const XMLElement& joint) {
    const auto* axis = joint.FirstChildElement("axis");
    const auto type = type_of(joint);
    if (!is_joint_of_robot(joint) || axis == nullptr || type == "fixed" || type == "floating") {
        return false;
    }
    const char* xyz = axis->Attribute("xyz");
    std::istringstream in{xyz == nullptr ? "1 0 0" : xyz};
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    return !(in >> x >> y >> z) || std::hypot(x, y, z) == 0.0;
}

bool mimics_nothing(const XMLElement& joint) {
    const auto* mimic = joint.FirstChildElement("mimic");
    return is_joint_of_robot(joint) && mimic != nullptr && mimic->Attribute("joint") == nullptr;
}

bool is_sensor_of_no_type(const XMLElement& sensor) {
    return is_called(sensor, "sensor") && sensor.Attribute("type") == nullptr;
}

struct Kind {
    bool (*is_faulty)(const XMLElement& element);
    std::string_view what;
    std::string_view fault;
    const XMLElement* first = nullptr;
    std::size_t count = 0;
};

void find(const XMLElement& element, std::span<Kind> kinds) {
    for (Kind& kind : kinds) {
        if (!kind.is_faulty(element)) continue;
        if (kind.count++ == 0) kind.first = &element;
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (!is_called(*child, "plugin")) find(*child, kinds);
    }
}

std::string warning_of(const Kind& kind, const std::filesystem::path& file) {
    return file.string() + ':' + std::to_string(kind.first->GetLineNum()) + ": the " +
           std::string{kind.what} + path_of(*kind.first) +
           (kind.count > 1 ? " (and " + std::to_string(kind.count - 1) + " more) " : " ") +
           std::string{kind.fault} + "; scanners do not need it, ignored";
}

std::vector<std::string> warnings_of(const XMLElement& root, const std::filesystem::path& file,
                                     std::span<Kind> kinds) {
    find(root, kinds);
    std::vector<std::string> warnings;
    for (const Kind& kind : kinds) {
        if (kind.count > 0) warnings.push_back(warning_of(kind, file));
    }
    return warnings;
}

}  // namespace

std::vector<std::string> faults_of_ignored(const XMLElement& root,
                                           const std::filesystem::path& file) {
    std::array<Kind, 6> kinds{
        Kind{has_invalid_inertia, "inertia of link ", "is impossible for any mass"},
        Kind{has_script_without_uri, "material script of ", "has no <uri>"},
        Kind{has_slippery_surface, "friction of collision ", "is below 0"},
        Kind{joins_nothing, "joint ", "joins a link that is not there"},
        Kind{is_of_no_type, "joint ", "has no known type"},
        Kind{is_sensor_of_no_type, "sensor ", "has no type"}};
    return warnings_of(root, file, kinds);
}

std::vector<std::string> faults_of_ignored_in_robot(const XMLElement& robot,
                                                    const std::filesystem::path& file) {
    std::array<Kind, 5> kinds{Kind{has_script_without_uri, "material script of ", "has no <uri>"},
                              Kind{is_of_no_type_of_robots, "joint ", "has no known type"},
                              Kind{has_no_limit, "joint ", "has no <limit> of effort and velocity"},
                              Kind{has_no_direction, "axis of joint ", "has no direction"},
                              Kind{mimics_nothing, "joint ", "has a <mimic> without a joint"}};
    return warnings_of(robot, file, kinds);
}

}  // namespace scipd::sim
