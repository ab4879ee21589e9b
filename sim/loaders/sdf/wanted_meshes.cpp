// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/wanted_meshes.h"

#include <string>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

class Search {
  public:
    Search(const std::filesystem::path& folder, const Resources& resources, SdfGeometry geometry)
        : folder_(folder),
          resources_(resources),
          surface_(geometry == SdfGeometry::visual ? "visual" : "collision") {}

    void look_into(const XMLElement& element) {
        if (element.Name() == surface_) return add(element);
        for (const auto* child = element.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            look_into(*child);
        }
    }

    std::vector<MeshSource> found;

  private:
    void add(const XMLElement& surface) {
        const auto* geometry = surface.FirstChildElement("geometry");
        const auto* mesh = geometry == nullptr ? nullptr : geometry->FirstChildElement("mesh");
        if (mesh == nullptr) return;
        // URDF has a filename attribute, SDF a <uri>.
        const char* filename = mesh->Attribute("filename");
        const std::string uri =
            filename != nullptr ? filename : text_of(mesh->FirstChildElement("uri"));
        const auto file = resources_.find(uri, folder_);
        if (file.empty()) return;
        const auto* submesh = mesh->FirstChildElement("submesh");
        const auto* name = submesh == nullptr ? nullptr : submesh->FirstChildElement("name");
        found.push_back({file, text_of(name)});
    }

    const std::filesystem::path& folder_;
    const Resources& resources_;
    std::string_view surface_;
};

}  // namespace

std::vector<MeshSource> wanted_meshes(const XMLElement& root, const std::filesystem::path& folder,
                                      const Resources& resources, SdfGeometry geometry) {
    Search search{folder, resources, geometry};
    search.look_into(root);
    return std::move(search.found);
}

}  // namespace scipd::sim
