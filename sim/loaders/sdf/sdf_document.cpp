// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_document.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <set>
#include <utility>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_road.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::array nothing_to_a_scanner{"atmosphere",
                                          "audio",
                                          "audio_sink",
                                          "audio_source",
                                          "battery",
                                          "blend",
                                          "cast_shadows",
                                          "enable_wind",
                                          "gravity",
                                          "gripper",
                                          "gui",
                                          "inertial",
                                          "kinematic",
                                          "light",
                                          "magnetic_field",
                                          "max_contacts",
                                          "must_be_base_link",
                                          "particle_emitter",
                                          "physics",
                                          "plugin",
                                          "projector",
                                          "scene",
                                          "self_collide",
                                          "sensor",
                                          "spherical_coordinates",
                                          "surface",
                                          "texture",
                                          "transparency",
                                          "use_terrain_paging",
                                          "velocity_decay",
                                          "visibility_flags",
                                          "wind"};
constexpr std::array seen_but_not_read{"population"};

constexpr std::string_view colons = "::";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Replaces every name of a frame, in attributes and in the text of these elements.
void for_each_reference(XMLElement& root, const std::function<std::string(std::string)>& replace) {
    constexpr std::array attributes{"relative_to", "attached_to", "frame", "placement_frame",
                                    "canonical_link"};
    constexpr std::array elements{"parent", "child", "placement_frame"};
    for_each(root, [&](XMLElement& element) {
        for (const char* name : attributes) {
            if (const char* value = element.Attribute(name)) {
                element.SetAttribute(name, replace(value).c_str());
            }
        }
        if (is_one_of(element, elements) && element.GetText() != nullptr) {
            element.SetText(replace(element.GetText()).c_str());
        }
    });
}

/// Gazebo Classic saves the links of nested models as links named MODEL::LINK.
void rename_with_colons(XMLElement& root) {
    std::set<std::string, std::greater<>> names;
    for_each(root, [&](XMLElement& element) {
        const char* name = element.Attribute("name");
        if (name == nullptr || std::string_view{name}.find(colons) == std::string_view::npos) {
            return;
        }
        names.insert(name);
        std::string renamed = name;
        replace_all(renamed, colons, stands_for_colons);
        element.SetAttribute("name", renamed.c_str());
    });
    if (names.empty()) return;
    for_each_reference(root, [&](std::string reference) {
        for (const auto& name : names) {
            std::string renamed = name;
            replace_all(renamed, colons, stands_for_colons);
            replace_all(reference, name, renamed);
        }
        return reference;
    });
}

/// Keeps only the joints that serve as a frame for something else.
void relieve_joints(XMLElement& root) {
    std::string references = " ";
    for_each_reference(root, [&](const std::string& reference) {
        references += reference + ' ';
        return reference;
    });
    for_each(root, [&](XMLElement& element) {
        delete_children(element, [&](XMLElement& joint) {
            if (std::string_view{joint.Name()} != "joint") return false;
            const char* name = joint.Attribute("name");
            if (name == nullptr || references.find(name + std::string{' '}) == references.npos) {
                return true;
            }
            // Scenes have every joint at zero, whatever its type.
            joint.SetAttribute("type", "fixed");
            constexpr std::array kept{"parent", "child", "pose"};
            delete_children(joint, [&](XMLElement& part) { return !is_one_of(part, kept); });
            return false;
        });
    });
}

/// Copies the text of a child into one of scipd's own, which the library takes as it is.
void keep_as_own(const XMLElement* parent, const char* name, XMLElement& surface) {
    const std::string text = parent == nullptr ? "" : text_of(parent->FirstChildElement(name));
    if (text.empty()) return;
    surface.InsertNewChildElement(("scipd:" + std::string{name}).c_str())->SetText(text.c_str());
}

/// Keeps what a surface looks like, as far as it says something of ranges.
void keep_appearance(XMLElement& surface) {
    const XMLElement* metal = &surface;
    for (const char* name : {"material", "pbr", "metal"})
        metal = metal == nullptr ? nullptr : metal->FirstChildElement(name);
    keep_as_own(&surface, "transparency", surface);
    keep_as_own(metal, "metalness", surface);
    keep_as_own(metal, "roughness", surface);
}

/// Keeps only the name of the material.
void relieve_material(XMLElement& surface) {
    auto* material = surface.FirstChildElement("material");
    if (material == nullptr) return;
    auto* script = material->FirstChildElement("script");
    const std::string name = script == nullptr ? "" : text_of(script->FirstChildElement("name"));
    if (!name.empty() && surface.FirstChildElement("scipd:material") == nullptr) {
        surface.InsertNewChildElement("scipd:material")->SetText(name.c_str());
    }
    delete_children(surface,
                    [](XMLElement& child) { return std::string_view{child.Name()} == "material"; });
}

bool is_empty_model(XMLElement& element) {
    return std::string_view{element.Name()} == "model" &&
           element.FirstChildElement("link") == nullptr &&
           element.FirstChildElement("model") == nullptr &&
           element.FirstChildElement("include") == nullptr;
}

void relieve_element(XMLElement& element) {
    if (std::string_view{element.Name()} == "visual") keep_appearance(element);
    delete_children(element,
                    [](XMLElement& child) { return is_one_of(child, nothing_to_a_scanner); });
    relieve_material(element);
    const char* frame = element.Attribute("frame");
    if (frame != nullptr && *frame == '\0') element.DeleteAttribute("frame");
    // No pose depends on which link is canonical.
    element.DeleteAttribute("canonical_link");
}

std::string mend_version(XMLElement& root) {
    int major = 0;
    int minor = 0;
    const char* version = root.Attribute("version");
    if (version != nullptr && std::sscanf(version, "%d.%d", &major, &minor) == 2) return {};
    root.SetAttribute("version", "1.9");
    return version == nullptr ? "has no version; it is read as SDF 1.9"
                              : "has a version that is not a number; it is read as SDF 1.9";
}

/// Keeps only the first model, as Gazebo does.
std::string drop_further_models(XMLElement& root) {
    auto* first = root.FirstChildElement("model");
    if (first == nullptr || first->NextSiblingElement("model") == nullptr) return {};
    delete_children(root, [&](XMLElement& child) {
        return &child != first && std::string_view{child.Name()} == "model";
    });
    return "holds several models outside a world; only the first is used";
}

}  // namespace

std::vector<std::string> take_unreadable(XMLElement& root, const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    const auto take = [&](XMLElement& child) {
        if (!is_one_of(child, seen_but_not_read)) return false;
        warnings.push_back(file.string() + ':' + std::to_string(child.GetLineNum()) + ": <" +
                           child.Name() + "> is not supported and left out");
        return true;
    };
    delete_children(root, take);
    for (auto* world = root.FirstChildElement("world"); world != nullptr;
         world = world->NextSiblingElement("world")) {
        delete_children(*world, take);
    }
    return warnings;
}

void put_in_its_words(XMLElement& root) {
    for_each(root, [](XMLElement& element) {
        if (std::string_view{element.Name()} != "geometry") return;
        if (auto* cone = element.FirstChildElement("cone")) cone->SetName("scipd:cone");
    });
    for (auto* world = root.FirstChildElement("world"); world != nullptr;
         world = world->NextSiblingElement("world")) {
        put_roads_as_models(*world);
    }
}

std::vector<std::string> lower_version(XMLElement& root, const std::filesystem::path& file) {
    constexpr std::pair known{1, 9};
    constexpr std::pair newest{1, 12};
    if (std::string_view{root.Name()} == "gazebo") root.SetName("sdf");
    int major = 0;
    int minor = 0;
    const char* version = root.Attribute("version");
    if (version == nullptr || std::sscanf(version, "%d.%d", &major, &minor) != 2) return {};
    const std::pair given{major, minor};
    if (given <= known) return {};
    root.SetAttribute("version", "1.9");
    if (given <= newest) return {};
    return {file.string() + ':' + std::to_string(root.GetLineNum()) + ": is of version " +
            std::to_string(major) + '.' + std::to_string(minor) +
            ", which is newer than any known here; it is read as SDF 1.9"};
}

std::vector<std::string> relieve(XMLElement& root, const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    for (const auto& warning : {mend_version(root), drop_further_models(root)}) {
        if (warning.empty()) continue;
        warnings.push_back(file.string() + ':' + std::to_string(root.GetLineNum()) + ": " +
                           warning);
    }
    root.SetAttribute("xmlns:scipd", "urn:scipd:sdf");
    for_each(root, relieve_element);
    relieve_joints(root);
    rename_with_colons(root);
    return warnings;
}

void drop_empty_models(XMLElement& root) {
    // Inner models first: a model may be empty once they are gone.
    for (auto* child = root.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
        drop_empty_models(*child);
    delete_children(root, is_empty_model);
}

std::string as_in_file(const std::string& name) {
    std::string text = name;
    replace_all(text, stands_for_colons, colons);
    return text;
}

}  // namespace scipd::sim
