// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/urdf.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_surface.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/pose.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// Called with a joint and what is wrong with it.
using Wrong = std::function<void(const tinyxml2::XMLElement& element, const std::string& what)>;

/// The tree that the joints of a URDF robot make of its links.
class UrdfTree {
  public:
    /// Leaves out joints that make no tree. `links` are the names of all.
    UrdfTree(const tinyxml2::XMLElement& robot, const std::set<std::string>& links,
             const Wrong& wrong);

    struct Hung {
        std::string parent;
        Pose parent_from_here;
        bool is_lost = false;  ///< the pose cannot be read
    };
    /// The parent of a link; null for a root.
    [[nodiscard]] const Hung* above(const std::string& link) const;
    /// True if the pose of its joint, or of one above, cannot be read.
    [[nodiscard]] bool is_lost(std::string link) const;

  private:
    [[nodiscard]] std::string fault_of(const tinyxml2::XMLElement& joint,
                                       const std::set<std::string>& links) const;

    std::map<std::string, Hung> above_;
};

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

/// Reads xyz and rpy of an <origin>. What cannot be read is 0 0 0, and told to `faults`.
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

using tinyxml2::XMLElement;

constexpr std::size_t longest_urdf_text = 200;

/// The numbers of an attribute. Throws UnreadableValue.
std::vector<double> numbers_in(const XMLElement& element, const char* name, std::size_t count) {
    const char* text = element.Attribute(name);
    const std::string what = std::string{"its <"} + element.Name();
    if (text == nullptr) throw UnreadableValue(what + "> has no " + name);
    if (auto numbers = parse_numbers(text, count)) return *numbers;
    throw UnreadableValue(what + ' ' + name + "='" + printable(text, longest_urdf_text) +
                          "'> cannot be read");
}

Geometry urdf_shape_of(const XMLElement& shape, const SdfSheet& sheet) {
    const std::string_view kind = shape.Name();
    if (kind == "box") {
        const auto n = numbers_in(shape, "size", 3);
        check_sizes({n[0], n[1], n[2]});
        return PlacedShape{Box{{n[0], n[1], n[2]}}, {}};
    }
    if (kind == "sphere") {
        const double radius_m = numbers_in(shape, "radius", 1)[0];
        check_sizes({radius_m});
        return PlacedShape{Sphere{radius_m}, {}};
    }
    if (kind == "cylinder") {
        const double radius_m = numbers_in(shape, "radius", 1)[0];
        const double length_m = numbers_in(shape, "length", 1)[0];
        check_sizes({radius_m, length_m});
        return PlacedShape{Cylinder{radius_m, length_m}, {}};
    }
    if (kind != "mesh") {
        throw UnreadableValue("URDF has no <" + printable(shape.Name(), longest_urdf_text) + '>');
    }
    NamedMesh mesh{{attribute(shape, "filename"), sheet.folder}, {}};
    if (mesh.file.uri.empty()) throw UnreadableValue("its <mesh> has no filename");
    if (shape.Attribute("scale") != nullptr) {
        const auto n = numbers_in(shape, "scale", 3);
        mesh.view.scale = {n[0], n[1], n[2]};
        check_scale(mesh.view.scale);
    }
    return mesh;
}

Geometry geometry_in(const XMLElement& part, const SdfSheet& sheet) {
    const auto* geometry = part.FirstChildElement("geometry");
    if (geometry == nullptr) return Unread{"it has no <geometry>"};
    const auto* shape = geometry->FirstChildElement();
    if (shape == nullptr) return Unread{"its <geometry> is empty"};
    return read_or_why([&] { return urdf_shape_of(*shape, sheet); });
}

/// What Gazebo's extensions say of a link.
struct Extension {
    std::string material;
    std::optional<double> retro_of_visuals;
    std::optional<double> retro_of_collisions;
};

std::optional<double> retro_in(const XMLElement& element) {
    for (const char* name : {"laserRetro", "laser_retro"}) {
        const auto n = parse_numbers(text_of(element.FirstChildElement(name)), 1);
        if (n) return n->front();
    }
    return std::nullopt;
}

std::map<std::string, Extension> extensions_of(const XMLElement& robot) {
    std::map<std::string, Extension> extensions;
    for (const XMLElement& element : Children(robot, "gazebo")) {
        Extension& extension = extensions[attribute(element, "reference")];
        const auto* visual = element.FirstChildElement("visual");
        if (visual != nullptr) extension.retro_of_visuals = retro_in(*visual);
        const auto* script = inside(element, {"visual", "material", "script", "name"});
        const std::string material = text_of(element.FirstChildElement("material"));
        if (!material.empty()) extension.material = trimmed(material);
        if (extension.material.empty()) extension.material = trimmed(text_of(script));
        const auto* collision = element.FirstChildElement("collision");
        if (const auto retro = retro_in(collision == nullptr ? element : *collision)) {
            extension.retro_of_collisions = retro;
        }
    }
    return extensions;
}

class RobotReader {
  public:
    RobotReader(const XMLElement& robot, const SdfSheet& sheet, SdfGeometry geometry,
                SceneDraft& draft)
        : robot_(robot),
          sheet_(sheet),
          geometry_(geometry),
          draft_(draft),
          extensions_(extensions_of(robot)) {}

    SdfPart read() {
        SdfPart model{SdfPart::Kind::model, attribute(robot_, "name"), sheet_.place(robot_)};
        for (const XMLElement& element : Children(robot_, "link")) {
            if (auto link = read_link(element)) model.parts.push_back(std::move(*link));
        }
        hang(model.parts);
        // It is the world that a robot of Gazebo hangs on, and no part of the robot.
        std::erase_if(model.parts, [](const SdfPart& link) {
            return link.name == "world" && link.surfaces.empty() && !link.has_unseen;
        });
        return model;
    }

  private:
    static std::string text_of_part(const std::string& kind, const std::string& name,
                                    const FilePlace& place) {
        return text_of(place) + ": " + kind +
               (name.empty() ? "" : ' ' + printable(name, longest_urdf_text)) + ": ";
    }

    std::optional<SdfPart> read_link(const XMLElement& element) {
        SdfPart link{SdfPart::Kind::link, attribute(element, "name"), sheet_.place(element)};
        const bool is_new = names_.insert(link.name).second;
        if (link.name.empty() || !is_new) {
            draft_.leave_out(text_of_part("link", link.name, link.place) +
                             (is_new ? "has no name" : "there is another of this name"));
            return std::nullopt;
        }
        auto visuals = read_surfaces(element, "visual", link.name);
        auto collisions = read_surfaces(element, "collision", link.name);
        put_surfaces(std::move(visuals), std::move(collisions), geometry_, link);
        return link;
    }

    std::vector<SdfSurface> read_surfaces(const XMLElement& link, const std::string& kind,
                                          const std::string& link_name) {
        std::vector<SdfSurface> surfaces;
        const Extension& extension = extensions_[link_name];
        int count = 0;
        for (const XMLElement& part : Children(link, kind.c_str())) {
            SdfSurface surface = read_surface(part, kind, link_name, count++);
            const bool is_visual = kind == "visual";
            if (is_visual && surface.material.empty()) surface.material = extension.material;
            surface.laser_retro =
                is_visual ? extension.retro_of_visuals : extension.retro_of_collisions;
            surfaces.push_back(std::move(surface));
        }
        return surfaces;
    }

    /// It is called as libsdformat calls it.
    SdfSurface read_surface(const XMLElement& part, const std::string& kind,
                            const std::string& link, int count) {
        const std::string own = attribute(part, "name");
        SdfSurface surface{link + (own.empty() ? "" : "_fixed_joint_lump__" + own) + '_' + kind +
                               (count == 0 ? "" : '_' + std::to_string(count)),
                           sheet_.place(part)};
        std::vector<std::string> faults;
        surface.pose.pose = pose_of_origin(part.FirstChildElement("origin"), faults);
        surface.geometry = faults.empty() ? geometry_in(part, sheet_) : Unread{faults.front()};
        if (const auto* material = part.FirstChildElement("material")) {
            surface.material = attribute(*material, "name");
        }
        return surface;
    }

    /// Puts each link where its joint has it.
    void hang(std::vector<SdfPart>& links) {
        const UrdfTree tree(
            robot_, names_, [this](const XMLElement& joint, const std::string& what) {
                const std::string name = attribute(joint, "name");
                draft_.warn(text_of_part("joint", name, sheet_.place(joint)) + what);
            });
        std::erase_if(links, [&](const SdfPart& link) { return tree.is_lost(link.name); });
        const auto is_root = [&](const SdfPart& link) { return tree.above(link.name) == nullptr; };
        const bool has_world = std::ranges::any_of(
            links, [&](const SdfPart& link) { return is_root(link) && link.name == "world"; });
        bool has_root = false;
        for (SdfPart& link : links) {
            if (const auto* hung = tree.above(link.name)) {
                link.pose = {hung->parent_from_here, hung->parent == "world" ? "" : hung->parent};
            } else if (has_world ? link.name != "world" : std::exchange(has_root, true)) {
                draft_.warn(text_of_part("link", link.name, link.place) +
                            "hangs on no joint; it stands at the origin of the robot");
            }
        }
    }

    const XMLElement& robot_;
    const SdfSheet& sheet_;
    SdfGeometry geometry_;
    SceneDraft& draft_;
    std::map<std::string, Extension> extensions_;
    std::set<std::string> names_;
};

}  // namespace

SdfPart robot_of(const XMLElement& robot, const SdfSheet& sheet, SdfGeometry geometry,
                 SceneDraft& draft) {
    return RobotReader(robot, sheet, geometry, draft).read();
}

std::vector<std::pair<std::string, const XMLElement*>> sensors_of_robot(const XMLElement& robot) {
    std::vector<std::pair<std::string, const XMLElement*>> sensors;
    for (const XMLElement& extension : Children(robot, "gazebo")) {
        const std::string link = attribute(extension, "reference");
        if (link.empty()) continue;
        for (const XMLElement& sensor : Children(extension, "sensor"))
            sensors.emplace_back(link, &sensor);
    }
    return sensors;
}

}  // namespace scipd::sim
