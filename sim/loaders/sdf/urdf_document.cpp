// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/urdf_document.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_ignored.h"
#include "sim/loaders/sdf/urdf_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;
using Names = std::initializer_list<std::string_view>;

constexpr std::size_t longest_text = 200;

void keep_children(XMLElement& element, Names names) {
    delete_children(element, [&](XMLElement& child) { return !is_one_of(child, names); });
}

struct Numbers {
    const char* element;
    const char* attribute;
    std::size_t count;
    bool is_required;
};

constexpr Numbers of_parts[] = {{"origin", "xyz", 3, false},     {"origin", "rpy", 3, false},
                                {"box", "size", 3, true},        {"sphere", "radius", 1, true},
                                {"cylinder", "radius", 1, true}, {"cylinder", "length", 1, true},
                                {"mesh", "scale", 3, false}};

/// What is wrong with the numbers of an element; empty if nothing.
std::string fault_of_numbers(const XMLElement& part) {
    for (const Numbers& numbers : of_parts) {
        if (std::string_view{part.Name()} != numbers.element) continue;
        const char* text = part.Attribute(numbers.attribute);
        if (text == nullptr && !numbers.is_required) continue;
        const std::string what = std::string{"its <"} + part.Name();
        if (text == nullptr) return what + "> has no " + numbers.attribute;
        if (parse_numbers(text, numbers.count)) continue;
        return what + ' ' + numbers.attribute + "='" + printable(text, longest_text) +
               "'> cannot be read";
    }
    return {};
}

/// What is wrong with a visual or collision, by the rules of urdfdom; empty if nothing.
std::string fault_of_shape(const XMLElement& part) {
    const auto* origin = part.FirstChildElement("origin");
    if (origin != nullptr) {
        if (auto fault = fault_of_numbers(*origin); !fault.empty()) return fault;
    }
    const auto* geometry = part.FirstChildElement("geometry");
    if (geometry == nullptr) return "it has no <geometry>";
    const auto* shape = geometry->FirstChildElement();
    if (shape == nullptr) return "its <geometry> is empty";
    if (!is_one_of(*shape, {"box", "cylinder", "mesh", "sphere"})) {
        return std::string{"URDF has no <"} + printable(shape->Name(), longest_text) + '>';
    }
    if (is_one_of(*shape, {"mesh"}) && attribute(*shape, "filename").empty()) {
        return "its <mesh> has no filename";
    }
    return fault_of_numbers(*shape);
}

/// Replaces the shape by a box: no scanner sees it, only its presence and its material count.
void make_plain(XMLElement& part) {
    keep_children(part, {"material"});
    part.InsertNewChildElement("geometry")
        ->InsertNewChildElement("box")
        ->SetAttribute("size", "1 1 1");
}

class Relief {
  public:
    Relief(const std::filesystem::path& file, SdfGeometry geometry)
        : file_(file), geometry_(geometry) {}

    std::vector<std::string> run(XMLElement& robot) {
        keep_children(robot, {"link", "joint", "material", "gazebo"});
        for (auto* part = robot.FirstChildElement(); part != nullptr;
             part = part->NextSiblingElement()) {
            if (is_one_of(*part, {"link"})) relieve_link(*part);
            if (is_one_of(*part, {"joint"})) relieve_joint(*part);
            if (is_one_of(*part, {"gazebo"})) relieve_extension(*part);
        }
        std::ranges::move(mend_tree(robot, file_), std::back_inserter(warnings_));
        return std::move(warnings_);
    }

  private:
    void relieve_link(XMLElement& link) {
        const std::string_view seen = geometry_ == SdfGeometry::visual ? "visual" : "collision";
        keep_children(link, {"visual", "collision"});
        delete_children(link, [&](XMLElement& part) {
            if (part.Name() != seen) {
                make_plain(part);
                return false;
            }
            const std::string fault = fault_of_shape(part);
            if (!fault.empty()) leave_out(link, part, fault);
            return !fault.empty();
        });
    }

    void leave_out(const XMLElement& link, const XMLElement& part, const std::string& why) {
        const std::string name = attribute(part, "name");
        warnings_.push_back(file_.string() + ':' + std::to_string(part.GetLineNum()) + ": link " +
                            printable(attribute(link, "name"), longest_text) + ": " + part.Name() +
                            (name.empty() ? "" : ' ' + printable(name, longest_text)) + ": " + why +
                            "; left out, no scanner sees it");
    }

    /// Scenes have every joint at zero, whatever its type.
    static void relieve_joint(XMLElement& joint) {
        joint.SetAttribute("type", "fixed");
        keep_children(joint, {"origin", "parent", "child"});
    }

    static void relieve_extension(XMLElement& extension) {
        if (attribute(extension, "reference").empty()) {
            drop_empty_models(extension);
            return keep_children(extension,
                                 {"static", "pose", "link", "frame", "model", "include"});
        }
        name_material(extension);
        delete_children(extension, [](XMLElement& part) {
            if (is_one_of(part, {"visual", "collision"})) {
                delete_children(part, [](XMLElement& child) { return !is_retro(child); });
                return part.NoChildren();
            }
            return !is_material(part) && !is_retro(part);
        });
    }

    /// Copies the name of a visual's material script into <material>, as Gazebo's URDF extension
    /// has it.
    static void name_material(XMLElement& extension) {
        auto* within = extension.FirstChildElement("visual");
        for (const char* name : {"material", "script", "name"})
            within = within == nullptr ? nullptr : within->FirstChildElement(name);
        if (within == nullptr || within->GetText() == nullptr) return;
        if (extension.FirstChildElement("material") != nullptr) return;
        extension.InsertNewChildElement("material")->SetText(within->GetText());
    }

    static bool is_material(const XMLElement& part) {
        return is_one_of(part, {"material"}) && part.GetText() != nullptr;
    }

    static bool is_retro(const XMLElement& part) {
        return is_one_of(part, {"laserRetro", "laser_retro"}) && part.GetText() != nullptr &&
               parse_numbers(part.GetText(), 1);
    }

    const std::filesystem::path& file_;
    SdfGeometry geometry_;
    std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> relieve_robot(XMLElement& robot, const std::filesystem::path& file,
                                       SdfGeometry geometry) {
    std::vector<std::string> warnings = faults_of_ignored_in_robot(robot, file);
    std::ranges::move(Relief{file, geometry}.run(robot), std::back_inserter(warnings));
    return warnings;
}

}  // namespace scipd::sim
