// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/urdf.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include <sdf/parser.hh>
#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/urdf_document.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

/// The material names of each link's visuals.
using MaterialNames = std::map<std::string, std::vector<std::string>>;

template <typename Visit>
void for_children(XMLElement& parent, const char* name, const Visit& visit) {
    for (auto* child = parent.FirstChildElement(name); child != nullptr;) {
        auto* next = child->NextSiblingElement(name);  // the visitor may delete the child
        visit(*child);
        child = next;
    }
}

/// Any inertia will do: the library drops links without one.
void give_inertia(XMLElement& link) {
    for_children(link, "inertial", [&](XMLElement& inertial) { link.DeleteChild(&inertial); });
    XMLElement& inertial = *link.InsertNewChildElement("inertial");
    inertial.InsertNewChildElement("mass")->SetAttribute("value", 1);
    XMLElement& inertia = *inertial.InsertNewChildElement("inertia");
    for (const char* diagonal : {"ixx", "iyy", "izz"})
        inertia.SetAttribute(diagonal, 1);
    for (const char* other : {"ixy", "ixz", "iyz"})
        inertia.SetAttribute(other, 0);
}

/// Returns the materials of a link's visuals and takes them out: urdfdom complains of names without
/// a colour.
std::vector<std::string> take_materials(XMLElement& link) {
    std::vector<std::string> names;
    for_children(link, "visual", [&](XMLElement& visual) {
        XMLElement* material = visual.FirstChildElement("material");
        names.push_back(material == nullptr ? "" : attribute(*material, "name"));
        if (material != nullptr) visual.DeleteChild(material);
    });
    return names;
}

void keep_joint(XMLElement& robot, const std::string& joint) {
    XMLElement& extension = *robot.InsertNewChildElement("gazebo");
    extension.SetAttribute("reference", joint.c_str());
    for (const char* setting : {"disableFixedJointLumping", "preserveFixedJoint"})
        extension.InsertNewChildElement(setting)->SetText("true");
}

/// The sensors in <gazebo reference="LINK">. The library would copy them, and refuse the robot for
/// a faulty one.
class Sensors {
  public:
    /// Takes the sensors out of the robot.
    explicit Sensors(XMLElement& robot) {
        for_children(robot, "gazebo", [&](XMLElement& extension) {
            const std::string link = attribute(extension, "reference");
            if (link.empty()) return;
            for_children(extension, "sensor", [&](XMLElement& sensor) {
                sensor.SetAttribute(line_mark, sensor.GetLineNum());
                all_.emplace_back(link, kept_.InsertEndChild(sensor.DeepClone(&kept_)));
                extension.DeleteChild(&sensor);
            });
        });
    }

    void put_into(XMLElement& model) {
        for_children(model, "link", [&](XMLElement& link) {
            for (const auto& [name, sensor] : all_) {
                if (name == attribute(link, "name"))
                    link.InsertEndChild(sensor->DeepClone(model.GetDocument()));
            }
        });
    }

  private:
    XMLDocument kept_;
    std::vector<std::pair<std::string, tinyxml2::XMLNode*>> all_;  ///< by link
};

void delete_sensors(XMLElement& model) {
    for_children(model, "link", [&](XMLElement& link) {
        for_children(link, "sensor", [&](XMLElement& sensor) { link.DeleteChild(&sensor); });
    });
}

MaterialNames prepare(XMLElement& robot) {
    MaterialNames materials;
    for_children(robot, "material", [&](XMLElement& material) { robot.DeleteChild(&material); });
    for_children(robot, "link", [&](XMLElement& link) {
        const std::string name = attribute(link, "name");
        if (name == "world") return;  // the library's name for what does not move
        give_inertia(link);
        materials[name] = take_materials(link);
    });
    for_children(robot, "joint", [&](XMLElement& joint) {
        if (attribute(joint, "type") == "fixed") keep_joint(robot, attribute(joint, "name"));
    });
    return materials;
}

/// Gives the visuals their materials again: the library keeps the visuals of a link in order.
void name_materials(XMLElement& model, const MaterialNames& materials) {
    for_children(model, "link", [&](XMLElement& link) {
        const auto known = materials.find(attribute(link, "name"));
        if (known == materials.end()) return;
        auto name = known->second.begin();
        for_children(link, "visual", [&](XMLElement& visual) {
            if (name == known->second.end()) return;
            if (!name->empty()) {
                visual.InsertNewChildElement("scipd:material")->SetText(name->c_str());
            }
            ++name;
        });
    });
}

std::string text_of(const XMLDocument& document) {
    tinyxml2::XMLPrinter printer;
    document.Print(&printer);
    return printer.CStr();
}

XMLElement* root_of(XMLDocument& document, std::string_view text, const char* name) {
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return nullptr;
    return document.FirstChildElement(name);
}

}  // namespace

bool is_urdf(std::string_view text) {
    XMLDocument document;
    return root_of(document, text, "robot") != nullptr;
}

std::string sdf_from_urdf(std::string_view text, const std::filesystem::path& file,
                          const SdfOptions& options, std::vector<FoundSensor>& sensors,
                          std::vector<std::string>& warnings) {
    XMLDocument urdf;
    XMLElement* robot = root_of(urdf, text, "robot");
    if (robot == nullptr) return {};
    Sensors extensions{*robot};
    if (!options.strict) {
        std::ranges::move(relieve_robot(*robot, file, options.geometry),
                          std::back_inserter(warnings));
    }
    const MaterialNames materials = prepare(*robot);

    const sdf::SDFPtr converted{new sdf::SDF};
    sdf::init(converted);
    sdf::Errors ignored;  // the library prints what matters
    if (!sdf::readString(text_of(urdf), converted, ignored)) return {};
    XMLDocument result;
    XMLElement* root = root_of(result, converted->ToString(), "sdf");
    XMLElement* model = root == nullptr ? nullptr : root->FirstChildElement("model");
    if (model == nullptr) return {};
    root->SetAttribute("xmlns:scipd", "urn:scipd:sdf");
    name_materials(*model, materials);
    extensions.put_into(*model);
    std::ranges::move(offer_sensors(*root, file, sensors), std::back_inserter(warnings));
    if (!options.strict) delete_sensors(*model);
    return text_of(result);
}

std::map<std::string, int> lines_of_links(std::string_view text) {
    XMLDocument document;
    XMLElement* robot = root_of(document, text, "robot");
    std::map<std::string, int> lines;
    if (robot == nullptr) return lines;
    for_children(*robot, "link", [&](XMLElement& link) {
        lines.insert({attribute(link, "name"), link.GetLineNum()});
    });
    return lines;
}

int line_in_urdf(std::string_view text, const std::string& message) {
    XMLDocument document;
    XMLElement* robot = root_of(document, text, "robot");
    if (robot == nullptr) return 0;
    for (const char* kind : {"joint", "link"}) {
        for (auto* part = robot->FirstChildElement(kind); part != nullptr;
             part = part->NextSiblingElement(kind)) {
            if (message.find('[' + attribute(*part, "name") + ']') != message.npos) {
                return part->GetLineNum();
            }
        }
    }
    return 0;
}

}  // namespace scipd::sim
