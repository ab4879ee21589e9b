// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_text.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/mesh/collada_primitive.h"
#include "sim/loaders/mesh/mesh_relief.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::array wanted_of_file{"asset",
                                    "library_controllers",
                                    "library_geometries",
                                    "library_materials",
                                    "library_nodes",
                                    "library_visual_scenes",
                                    "scene"};
constexpr std::array unwanted{"bind", "bind_vertex_input", "extra", "instance_camera",
                              "instance_light"};
/// The source of a controller may be another controller; longer chains are not followed.
constexpr int longest_chain = 8;

/// For each skin and morph, "#" and its id: the source that it changes.
std::map<std::string, std::string> sources_of_controllers(XMLElement& root) {
    std::map<std::string, std::string> sources;
    for_each(root, [&](XMLElement& element) {
        if (!is_one_of(element, std::array{"controller"})) return;
        for (const char* kind : {"skin", "morph"}) {
            if (const auto* inside = element.FirstChildElement(kind)) {
                sources[std::string{"#"}.append(attribute(element, "id"))] =
                    attribute(*inside, "source");
            }
        }
    });
    return sources;
}

/// Makes an instance show the mesh itself, without controllers.
void uncover(XMLElement& instance, const std::map<std::string, std::string>& sources) {
    std::string url = attribute(instance, "url");
    for (int link = 0; link < longest_chain; ++link) {
        const auto source = sources.find(url);
        if (source == sources.end()) break;
        url = source->second;
    }
    instance.SetName("instance_geometry");
    instance.SetAttribute("url", url.c_str());
    delete_children(
        instance, [](XMLElement& child) { return !is_one_of(child, std::array{"bind_material"}); });
}

}  // namespace

std::string relieved_collada(std::string_view text) {
    std::string bare{text};
    blank_comments(bare);
    tinyxml2::XMLDocument document;
    if (document.Parse(bare.data(), bare.size()) != tinyxml2::XML_SUCCESS ||
        document.RootElement() == nullptr) {
        throw std::runtime_error("is no XML that can be read");
    }
    XMLElement& root = *document.RootElement();
    delete_children(root, [](XMLElement& child) { return !is_one_of(child, wanted_of_file); });
    const auto sources = sources_of_controllers(root);
    delete_children(root, [](XMLElement& child) {
        return is_one_of(child, std::array{"library_controllers"});
    });
    for_each(root, [&](XMLElement& element) {
        delete_children(element, [](XMLElement& child) { return is_one_of(child, unwanted); });
        if (is_one_of(element, std::array{"instance_controller"})) uncover(element, sources);
        if (is_one_of(element, std::array{"mesh"})) relieve_collada_mesh(element);
    });
    tinyxml2::XMLPrinter printer{nullptr, true};
    document.Accept(&printer);
    return printer.CStr();
}

}  // namespace scipd::sim
