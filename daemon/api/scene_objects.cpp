// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scene_objects.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <span>
#include <variant>

#include "daemon/api/documents.h"
#include "sim/export/placed_mesh.h"
#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

static_assert(std::endian::native == std::endian::little, "pages read little-endian");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12);

template <class Element>
std::string_view bytes_of(const std::vector<Element>& list) {
    return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Element)};
}

std::string encoded(const sim::Mesh& mesh) {
    const std::vector<std::uint32_t> head{SceneObjects::magic,
                                          static_cast<std::uint32_t>(mesh.vertices_m.size()),
                                          static_cast<std::uint32_t>(mesh.triangles.size())};
    std::string text;
    const auto parts = {bytes_of(head), bytes_of(mesh.vertices_m), bytes_of(mesh.triangles)};
    text.reserve(head.size() * sizeof(head[0]) + bytes_of(mesh.vertices_m).size() +
                 bytes_of(mesh.triangles).size());
    for (const std::string_view part : parts)
        text += part;
    return text;
}

std::string encoded(const sim::Shape& shape) {
    if (const auto* const mesh = std::get_if<sim::SharedMesh>(&shape)) return encoded(**mesh);
    return encoded(sim::tessellate(shape, sim::export_tolerance_m));
}

std::string hash_of(std::string_view bytes) {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx",
                  static_cast<unsigned long long>(sim::fnv1a<std::uint64_t>(bytes)));
    return digits.data();
}

/// Hashes each shape once.
class Hashes {
  public:
    const std::string& of(const sim::Shape& shape) {
        const Key key = std::visit(*this, shape);
        std::string& hash = known_[key];
        if (hash.empty()) hash = hash_of(encoded(shape));
        return hash;
    }

    /// What tells shapes apart: the kind, a number, or the mesh.
    struct Key {
        int kind;
        double number;
        const sim::Mesh* mesh;
        auto operator<=>(const Key&) const = default;
    };
    Key operator()(const sim::Box&) const { return {0, 0.0, nullptr}; }
    Key operator()(const sim::Plane&) const { return {1, 0.0, nullptr}; }
    Key operator()(const sim::Cylinder& cylinder) const { return {2, cylinder.radius_m, nullptr}; }
    Key operator()(const sim::Sphere& sphere) const { return {3, sphere.radius_m, nullptr}; }
    Key operator()(const sim::SharedMesh& mesh) const { return {4, 0.0, mesh.get()}; }

  private:
    std::map<Key, std::string> known_;
};

std::string told_of(const sim::Scene& scene, sim::ObjectId id, const std::string& hash,
                    const glm::dvec3& scale) {
    const sim::Object& object = scene.objects[id];
    const sim::Model& model = scene.models[object.model];
    std::string text = text_of(Json{{"id", id},
                                    {"name", object.name},
                                    {"model", model.name},
                                    {"movable", model.movable},
                                    {"material", scene.materials[object.material].name},
                                    {"mesh", hash},
                                    {"scale", {scale.x, scale.y, scale.z}},
                                    {"in_model", pose_document(object.model_from_object)}});
    text.pop_back();
    return text;
}

}  // namespace

SceneObjects::SceneObjects(const sim::SharedScene& scene) : scene_(scene) {
    Hashes hashes;
    texts_.reserve(scene->objects.size());
    for (sim::ObjectId id = 0; id < scene->objects.size(); ++id) {
        const auto [shape, scale] = sim::stretched(scene->objects[id].shape);
        const std::string& hash = hashes.of(shape);
        hashes_.push_back(&with_hash_.emplace(hash, id).first->first);
        texts_.push_back(told_of(*scene, id, hash, scale));
    }
}

std::optional<std::string> SceneObjects::triangles(std::string_view hash) const {
    const auto found = with_hash_.find(hash);
    const sim::SharedScene scene = scene_.lock();
    if (found == with_hash_.end() || !scene) return std::nullopt;
    return encoded(sim::stretched(scene->objects[found->second].shape).shape);
}

}  // namespace scipd::daemon
