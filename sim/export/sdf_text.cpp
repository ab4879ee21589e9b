// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/sdf_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <tinyxml2.h>

namespace scipd::sim {
namespace {

constexpr std::string_view between_names = "::";

/// The shortest text that is this number again.
std::string text_of(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.begin(), digits.end(), number).ptr};
}

std::string text_of(std::initializer_list<double> numbers) {
    std::string text;
    for (const double number : numbers) {
        if (!text.empty()) text += ' ';
        text += text_of(number);
    }
    return text;
}

/// As SDF lets a link or a visual be called.
std::string without_colons(std::string name) {
    std::ranges::replace(name, ':', '_');
    if (name.empty()) name = "unnamed";
    return name;
}

std::vector<std::string> split(const std::string& name) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (auto end = name.find(between_names); end != std::string::npos;
         end = name.find(between_names, begin)) {
        parts.push_back(name.substr(begin, end - begin));
        begin = end + between_names.size();
    }
    parts.push_back(name.substr(begin));
    return parts;
}

/// An element that ends with its scope.
class Element {
  public:
    Element(tinyxml2::XMLPrinter& printer, const char* tag, const std::string& name = {})
        : printer_(printer) {
        printer_.OpenElement(tag);
        if (!name.empty()) printer_.PushAttribute("name", name.c_str());
    }
    Element(const Element&) = delete;
    Element& operator=(const Element&) = delete;
    ~Element() { printer_.CloseElement(); }

  private:
    tinyxml2::XMLPrinter& printer_;
};

class Writer {
  public:
    Writer(const Scene& scene, std::span<const Pose> poses, const MeshUri& uri)
        : scene_(scene), poses_(poses), uri_(uri), parts_(scene.models.size()) {
        for (ObjectId id = 0; id < scene.objects.size(); ++id)
            parts_[scene.objects[id].model].push_back(id);
    }

    std::string write() {
        {
            const Element sdf(printer_, "sdf");
            printer_.PushAttribute("version", "1.9");
            printer_.PushAttribute("xmlns:scipd", "urn:scipd:sdf");
            const Element world(printer_, "world", scene_.name.empty() ? "world" : scene_.name);
            for (const auto& [outer, models] : by_outermost())
                write_outermost(outer, models);
        }
        return printer_.CStr();
    }

  private:
    /// In the order of their first models.
    std::vector<std::pair<std::string, std::vector<ModelId>>> by_outermost() const {
        std::vector<std::pair<std::string, std::vector<ModelId>>> groups;
        std::map<std::string, std::size_t> places;
        for (ModelId id = 0; id < scene_.models.size(); ++id) {
            const std::string outer = split(scene_.models[id].name).front();
            const auto [place, fresh] = places.emplace(outer, groups.size());
            if (fresh) groups.push_back({outer, {}});
            groups[place->second].second.push_back(id);
        }
        return groups;
    }

    /// What lies in a model and is one of its own can be moved, and the outer one cannot.
    void write_outermost(const std::string& outer, const std::vector<ModelId>& models) {
        const Element model(printer_, "model", outer);
        const auto own = find_model(scene_, outer);
        const bool movable = own && scene_.models[*own].movable;
        write_text("static", movable ? "false" : "true");
        const Pose place = own ? poses_[*own] : Pose{};
        write_pose(place);
        if (own) write_links(*own);
        for (const ModelId id : models) {
            if (id != own) write_nested(id, inverse(place) * poses_[id]);
        }
    }

    void write_nested(ModelId id, const Pose& outer_from_model) {
        std::vector<std::string> names = split(scene_.models[id].name);
        names.erase(names.begin());
        for (const std::string& name : names) {
            printer_.OpenElement("model");
            printer_.PushAttribute("name", name.c_str());
        }
        write_text("static", "false");
        write_pose(outer_from_model);
        write_links(id);
        for (std::size_t i = 0; i < names.size(); ++i)
            printer_.CloseElement();
    }

    /// Each object in a link of its own name, at the place of the model.
    void write_links(ModelId id) {
        std::map<std::string, std::vector<std::pair<std::string, ObjectId>>> links;
        std::set<std::string> taken;
        for (const ObjectId object : parts_[id]) {
            auto [link, visual] = names_of(object, scene_.models[id].name);
            const std::string wish = visual;
            for (int n = 2; !taken.insert(link + " " + visual).second; ++n)
                visual = wish + "_" + std::to_string(n);
            links[link].emplace_back(visual, object);
        }
        for (const auto& [name, visuals] : links) {
            const Element link(printer_, "link", name);
            for (const auto& [visual, object] : visuals)
                write_visual(visual, scene_.objects[object], object);
        }
    }

    std::pair<std::string, std::string> names_of(ObjectId id, const std::string& model) const {
        std::string name = scene_.objects[id].name;
        if (name.starts_with(model + "::")) name.erase(0, model.size() + between_names.size());
        const auto last = name.rfind(between_names);
        if (last == std::string::npos) return {"link", without_colons(name)};
        return {without_colons(name.substr(0, last)), name.substr(last + between_names.size())};
    }

    void write_visual(const std::string& name, const Object& object, ObjectId id) {
        const Element visual(printer_, "visual", name);
        write_pose(object.model_from_object);
        {
            const Element geometry(printer_, "geometry");
            std::visit([&](const auto& shape) { write_shape(shape, id); }, object.shape);
        }
        write_material(scene_.materials[object.material]);
    }

    void write_shape(const Box& box, ObjectId /*id*/) {
        const Element element(printer_, "box");
        write_text("size", text_of({box.size_m.x, box.size_m.y, box.size_m.z}));
    }
    void write_shape(const Cylinder& cylinder, ObjectId /*id*/) {
        const Element element(printer_, "cylinder");
        write_text("radius", text_of(cylinder.radius_m));
        write_text("length", text_of(cylinder.length_m));
    }
    void write_shape(const Sphere& sphere, ObjectId /*id*/) {
        const Element element(printer_, "sphere");
        write_text("radius", text_of(sphere.radius_m));
    }
    void write_shape(const Plane& plane, ObjectId /*id*/) {
        const Element element(printer_, "plane");
        write_text("normal", "0 0 1");
        write_text("size", text_of({plane.size_m.x, plane.size_m.y}));
    }
    void write_shape(const SharedMesh& /*mesh*/, ObjectId id) {
        const Element element(printer_, "mesh");
        write_text("uri", uri_(id));
    }

    /// The name that a library may know, and what the world says besides (docs/materials.md).
    void write_material(const Material& material) {
        if (!material.from_script) write_text("scipd:material", material.name);
        if (material.laser_retro) write_text("laser_retro", text_of(*material.laser_retro));
        const Appearance& look = material.appearance;
        if (look.transparency) write_text("transparency", text_of(*look.transparency));
        if (!material.from_script && !look.metalness && !look.roughness) return;
        const Element element(printer_, "material");
        if (material.from_script) {
            const Element script(printer_, "script");
            write_text("name", material.name);
        }
        if (!look.metalness && !look.roughness) return;
        const Element pbr(printer_, "pbr");
        const Element metal(printer_, "metal");
        if (look.metalness) write_text("metalness", text_of(*look.metalness));
        if (look.roughness) write_text("roughness", text_of(*look.roughness));
    }

    void write_pose(const Pose& pose) {
        const auto& [xyz, q] = pose;
        const Element element(printer_, "pose");
        printer_.PushAttribute("rotation_format", "quat_xyzw");
        printer_.PushText(text_of({xyz.x, xyz.y, xyz.z, q.x, q.y, q.z, q.w}).c_str());
    }

    void write_text(const char* tag, const std::string& text) {
        const Element element(printer_, tag);
        printer_.PushText(text.c_str());
    }

    const Scene& scene_;
    std::span<const Pose> poses_;
    const MeshUri& uri_;
    std::vector<std::vector<ObjectId>> parts_;  ///< by ModelId
    tinyxml2::XMLPrinter printer_;
};

}  // namespace

std::string sdf_of(const Scene& scene, std::span<const Pose> world_from_model, const MeshUri& uri) {
    return Writer(scene, world_from_model, uri).write();
}

}  // namespace scipd::sim
