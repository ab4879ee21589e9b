// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/overlap.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include <glm/common.hpp>

#include "sim/world/bounds.h"

namespace scipd::sim {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
/// What is nearer together is at one place, and what is thinner is met all the same.
constexpr float skin_m = 1e-5F;

/// In floats, since a world has many.
struct SmallBox {
    glm::vec3 low_m{infinite};
    glm::vec3 high_m{-infinite};

    void include(const glm::vec3& point_m) {
        low_m = glm::min(low_m, point_m);
        high_m = glm::max(high_m, point_m);
    }
    [[nodiscard]] glm::vec3 twice_the_middle_m() const { return low_m + high_m; }
    [[nodiscard]] bool empty() const { return low_m.x > high_m.x; }
    [[nodiscard]] bool meets(const SmallBox& other) const {
        return glm::all(glm::lessThanEqual(low_m, other.high_m)) &&
               glm::all(glm::lessThanEqual(other.low_m, high_m));
    }
    /// Half of the surface: of two boxes, one in the other, rays that meet the outer one meet the
    /// inner one as often as its surface is a part of the outer one's (Cauchy).
    [[nodiscard]] double half_surface() const {
        const glm::dvec3 size_m = glm::dvec3{high_m - low_m} + double{skin_m};
        return size_m.x * size_m.y + size_m.y * size_m.z + size_m.z * size_m.x;
    }
};

/// The box of one triangle, or of a shape that is round or has corners.
struct Item {
    SmallBox box;
    ObjectId object;
    std::uint32_t triangles;
};

/// A ray that goes through a box meets two faces of two triangles each.
constexpr std::uint32_t triangles_met_of_shape = 4;

const Mesh* mesh_of(const Object& object) {
    const auto* const mesh = std::get_if<SharedMesh>(&object.shape);
    return mesh == nullptr ? nullptr : mesh->get();
}

double most_met(const Object& object) {
    const Mesh* const mesh = mesh_of(object);
    return mesh == nullptr ? triangles_met_of_shape : double(mesh->triangles.size());
}

int widest(const glm::vec3& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

/// Halves the space again and again, as a search by boxes does, and looks at each part.
class Search {
  public:
    explicit Search(double most) : most_(most) {}

    void look(std::span<Item> items) {
        SmallBox around;
        SmallBox middles;
        double all = 0.0;
        double met = 0.0;
        for (const Item& item : items) {
            around.include(item.box.low_m);
            around.include(item.box.high_m);
            middles.include(item.box.twice_the_middle_m());
            all += item.triangles;
            met += item.triangles * item.box.half_surface();
        }
        if (all <= most_) return;
        met /= around.half_surface();
        if (met > worst_) {
            worst_ = met;
            object_ = items.front().object;
            middle_m_ = 0.5 * glm::dvec3{around.twice_the_middle_m()};
        }
        const glm::vec3 size_m = middles.high_m - middles.low_m;
        const int axis = widest(size_m);
        if (size_m[axis] <= skin_m) return;
        const float cut_m = middles.low_m[axis] + 0.5F * size_m[axis];
        const auto rest = std::partition(items.begin(), items.end(), [&](const Item& item) {
            return item.box.twice_the_middle_m()[axis] <= cut_m;
        });
        look({items.begin(), rest});
        look({rest, items.end()});
    }

    /// Relative to the frame of the items.
    [[nodiscard]] std::optional<Overlap> worst(const Scene& scene) const {
        if (worst_ <= most_) return std::nullopt;
        return Overlap{worst_, scene.objects[object_].name, middle_m_};
    }

  private:
    double most_;
    double worst_ = 0.0;
    ObjectId object_ = 0;
    glm::dvec3 middle_m_{0.0};
};

SmallBox small(const Bounds& bounds) {
    SmallBox box;
    box.include(glm::vec3{bounds.low_m});
    box.include(glm::vec3{bounds.high_m});
    return box;
}

/// Adds what of the object meets the box.
void collect(const Scene& scene, ObjectId id, const Pose& here_from_object, const SmallBox& within,
             std::vector<Item>& items) {
    const auto add = [&](const SmallBox& box, std::uint32_t triangles) {
        if (box.meets(within)) items.push_back({box, id, triangles});
    };
    const Object& object = scene.objects[id];
    const Mesh* const mesh = mesh_of(object);
    if (mesh == nullptr) {
        Bounds bounds;
        bounds.include(bounds_of(object.shape), here_from_object);
        return add(small(bounds), triangles_met_of_shape);
    }
    std::vector<glm::vec3> vertices_m;
    vertices_m.reserve(mesh->vertices_m.size());
    for (const glm::vec3& vertex : mesh->vertices_m)
        vertices_m.emplace_back(here_from_object * glm::dvec3{vertex});
    for (const glm::uvec3& triangle : mesh->triangles) {
        SmallBox box;
        for (int corner = 0; corner < 3; ++corner)
            box.include(vertices_m[triangle[corner]]);
        add(box, 1);
    }
}

/// Around what of `added` stands still, in W relative to the anchor of the scene.
SmallBox around_still(const Scene& added, const glm::dvec3& anchor_m) {
    Bounds bounds;
    for (const Object& object : added.objects) {
        const Model& model = added.models[object.model];
        if (model.movable) continue;
        bounds.include(bounds_of(object.shape), model.world_from_model * object.model_from_object);
    }
    return bounds.empty() ? SmallBox{} : small({bounds.low_m - anchor_m, bounds.high_m - anchor_m});
}

std::optional<Overlap> worst_of_still(const Scene& scene, const Scene& added, double most) {
    const SmallBox within = around_still(added, scene.anchor_m);
    std::vector<Item> items;
    if (within.empty()) return std::nullopt;
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        const Model& model = scene.models[object.model];
        if (model.movable) continue;
        Pose here_from_object = model.world_from_model * object.model_from_object;
        here_from_object.translation_m -= scene.anchor_m;
        collect(scene, id, here_from_object, within, items);
    }
    Search search(most);
    search.look(items);
    auto worst = search.worst(scene);
    if (worst) worst->middle_m += scene.anchor_m;
    return worst;
}

using Body = std::vector<ObjectId>;

/// The movable models that are more than `most` triangles, which few are.
std::vector<Body> large_bodies(const Scene& scene, double most) {
    std::vector<Body> bodies(scene.models.size());
    std::vector<double> triangles(scene.models.size());
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        if (!scene.models[object.model].movable) continue;
        bodies[object.model].push_back(id);
        triangles[object.model] += most_met(object);
    }
    std::erase_if(bodies, [&](const Body& body) {
        return body.empty() || triangles[scene.objects[body.front()].model] <= most;
    });
    return bodies;
}

/// As robots of one kind are.
bool alike(const Scene& scene, const Body& a, const Body& b) {
    return std::ranges::equal(a, b, [&](ObjectId one, ObjectId other) {
        const Mesh* const mesh = mesh_of(scene.objects[one]);
        return mesh != nullptr && mesh == mesh_of(scene.objects[other]) &&
               scene.objects[one].model_from_object == scene.objects[other].model_from_object;
    });
}

std::optional<Overlap> worst_of_body(const Scene& scene, const Body& body, double most) {
    constexpr SmallBox everywhere{glm::vec3{-infinite}, glm::vec3{infinite}};
    std::vector<Item> items;
    for (const ObjectId id : body)
        collect(scene, id, scene.objects[id].model_from_object, everywhere, items);
    Search search(most);
    search.look(items);
    auto worst = search.worst(scene);
    const Model& model = scene.models[scene.objects[body.front()].model];
    if (worst) worst->middle_m = model.world_from_model * worst->middle_m;
    return worst;
}

bool worse(const std::optional<Overlap>& a, const std::optional<Overlap>& b) {
    return a && (!b || a->triangles > b->triangles);
}

}  // namespace

std::optional<Overlap> worst_overlap(const Scene& scene, const Scene& added, double most) {
    std::optional<Overlap> worst = worst_of_still(scene, added, most);
    const std::vector<Body> bodies = large_bodies(added, most);
    for (auto body = bodies.begin(); body != bodies.end(); ++body) {
        const auto same = [&](const Body& other) { return alike(added, *body, other); };
        if (std::any_of(bodies.begin(), body, same)) continue;
        const auto of_body = worst_of_body(added, *body, most);
        if (worse(of_body, worst)) worst = of_body;
    }
    return worst;
}

}  // namespace scipd::sim
