// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All scenes are robust: without, rays that aim at shared edges slip through a few times in a
// million.
#include "sim/backends/embree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>

#include "sim/backends/embree_api.h"
#include "sim/backends/embree_bodies.h"
#include "sim/backends/embree_still.h"

namespace scipd::sim {
namespace {

/// The same direction to a nanoradian. Embree 3.13 loses all rays of a packet that share their
/// signs with one whose component is 1e-17 or so, as the cosine of a right angle comes out.
glm::vec3 apart_from_zero(const glm::vec3& direction) {
    constexpr float least = 1e-9F;
    const auto apart = [](float x) { return std::abs(x) < least ? std::copysign(least, x) : x; };
    return {apart(direction.x), apart(direction.y), apart(direction.z)};
}

/// One pose as the packets need it: float, relative to the anchor.
struct View {
    View(const Pose& pose, const glm::dvec3& anchor_m)
        : anchored_from_sensor(glm::mat3_cast(pose.rotation)),
          origin_m(pose.translation_m - anchor_m) {}

    glm::mat3 anchored_from_sensor;
    glm::vec3 origin_m;
};

class EmbreeBackend final : public RangeBackend {
  public:
    explicit EmbreeBackend(SharedScene shared_scene);

  private:
    struct Movable {
        GeometryHandle instance;
        glm::mat3 world_from_model;
        std::uint64_t cast = 0;  ///< the latest that can meet it
        bool shown = true;       ///< in the scene at present
    };

    void add_movable_models();
    void do_move(ModelId model, const Pose& world_from_model) override;
    void do_cast(const Fan& fan, std::span<Hit> hits) override;
    [[nodiscard]] bool follows_light() const override { return true; }
    void do_cast_with_normals(const Fan& fan, std::span<Hit> hits,
                              std::span<glm::vec3> world_normals) override;
    /// Calls `read(packet, first, count)` for each packet of rays that has been traced.
    template <class Read>
    void trace(const Fan& fan, Read read);
    void show(std::span<const ModelId> models);

    void aim(const Fan& fan, std::size_t first, std::size_t count, RTCRayHit16& packet) const;
    void turn_normals_of_movables(RTCRayHit16& packet) const;
    /// The object that ray k has hit.
    [[nodiscard]] ObjectId met(const RTCHit16& hit, std::size_t k) const;
    void read(const RTCRayHit16& packet, std::span<Hit> hits) const;

    std::shared_ptr<const EmbreeStill> still_;
    DeviceHandle device_;                  ///< of what moves; null where nothing can
    EmbreeBodies bodies_;                  ///< of the same device
    SceneHandle moving_;                   ///< instances, under their models' ids
    std::vector<Movable> movables_;        ///< by ModelId; empty where nothing can move
    std::vector<MaterialId> material_of_;  ///< by ObjectId
    std::vector<ModelId> instances_;       ///< all movable models with geometry
    int shown_count_ = 0;
    std::uint64_t casts_ = 0;
    bool moved_ = false;
};

EmbreeBackend::EmbreeBackend(SharedScene shared_scene)
    : RangeBackend(shared_scene), still_(still_part(shared_scene)) {
    for (const Object& object : scene().objects)
        material_of_.push_back(object.material);
    add_movable_models();
}

void EmbreeBackend::add_movable_models() {
    const std::vector<Model>& models = scene().models;
    if (std::ranges::none_of(models, &Model::movable)) return;
    device_ = new_device();
    moving_ = new_scene(device_.get());
    bodies_ = EmbreeBodies{device_.get(), scene()};
    movables_.resize(models.size());
    for (ModelId id = 0; id < models.size(); ++id) {
        if (bodies_.of(id) == nullptr) continue;
        movables_[id].instance.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(movables_[id].instance.get(), bodies_.of(id));
        rtcAttachGeometryByID(moving_.get(), movables_[id].instance.get(), id);
        instances_.push_back(id);
        do_move(id, models[id].world_from_model);
    }
    shown_count_ = static_cast<int>(instances_.size());
    require_built(device_.get(), scene());
}

void EmbreeBackend::do_move(ModelId model, const Pose& world_from_model) {
    Movable& movable = movables_[model];
    if (!movable.instance) return;  // a model without geometry
    movable.world_from_model = glm::mat3_cast(world_from_model.rotation);
    const glm::mat4x3 anchored_from_model{
        movable.world_from_model[0], movable.world_from_model[1], movable.world_from_model[2],
        glm::vec3{anchored(scene(), world_from_model).translation_m}};
    rtcSetGeometryTransform(movable.instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            glm::value_ptr(anchored_from_model));
    rtcCommitGeometry(movable.instance.get());
    moved_ |= movable.shown;
}

// A commit costs as much for each instance that is in the scene, moved or not, and so do rays.
void EmbreeBackend::show(std::span<const ModelId> models) {
    ++casts_;
    for (const ModelId model : models)
        movables_[model].cast = casts_;
    for (const ModelId model : instances_) {
        Movable& movable = movables_[model];
        const bool shown = movable.cast == casts_;
        if (shown == movable.shown) continue;
        if (shown) {
            rtcEnableGeometry(movable.instance.get());
        } else {
            rtcDisableGeometry(movable.instance.get());
        }
        movable.shown = shown;
        shown_count_ += shown ? 1 : -1;
        moved_ = true;
    }
}

void EmbreeBackend::do_cast(const Fan& fan, std::span<Hit> hits) {
    trace(fan, [&](const RTCRayHit16& packet, std::size_t first, std::size_t count) {
        read(packet, hits.subspan(first, count));
    });
}

void EmbreeBackend::do_cast_with_normals(const Fan& fan, std::span<Hit> hits,
                                         std::span<glm::vec3> world_normals) {
    trace(fan, [&](const RTCRayHit16& packet, std::size_t first, std::size_t count) {
        read(packet, hits.subspan(first, count));
        const RTCHit16& hit = packet.hit;
        for (std::size_t k = 0; k < count; ++k) {
            world_normals[first + k] =
                hits[first + k].met()
                    ? glm::normalize(glm::vec3{hit.Ng_x[k], hit.Ng_y[k], hit.Ng_z[k]})
                    : glm::vec3{0.0F};
        }
    });
}

template <class Read>
void EmbreeBackend::trace(const Fan& fan, Read read) {
    const DenormalsAsZero while_casting;
    show(fan.can_meet.value_or(std::span<const ModelId>{instances_}));
    if (std::exchange(moved_, false)) rtcCommitScene(moving_.get());
    CoherentTracer tracer{fan.unseen};
    RTCRayHit16 packet{};
    std::ranges::fill(packet.ray.mask, ~0U);
    const std::size_t rays = fan.directions.size();
    for (std::size_t first = 0; first < rays; first += packet_size) {
        const std::size_t count = std::min(packet_size, rays - first);
        alignas(64) int valid[packet_size] = {};
        std::fill_n(valid, count, -1);
        aim(fan, first, count, packet);
        tracer.trace(valid, still_->scene.get(), packet);
        if (shown_count_ > 0) {
            // The hits so far have shortened the rays: only what stands before them is met.
            tracer.trace(valid, moving_.get(), packet);
            turn_normals_of_movables(packet);
        }
        read(packet, first, count);
    }
}

void EmbreeBackend::aim(const Fan& fan, std::size_t first, std::size_t count,
                        RTCRayHit16& packet) const {
    std::size_t pose = fan.pose_index(first);
    View view{fan.world_from_sensor[pose], scene().anchor_m};
    const bool one_pose = fan.world_from_sensor.size() == 1;
    std::size_t next = one_pose ? fan.directions.size() : (pose + 1) * fan.directions_per_pose;
    for (std::size_t k = 0; k < count; ++k) {
        if (first + k == next) {
            view = View{fan.world_from_sensor[++pose], scene().anchor_m};
            next += fan.directions_per_pose;
        }
        const glm::vec3 direction =
            apart_from_zero(view.anchored_from_sensor * fan.directions[first + k]);
        packet.ray.org_x[k] = view.origin_m.x;
        packet.ray.org_y[k] = view.origin_m.y;
        packet.ray.org_z[k] = view.origin_m.z;
        packet.ray.dir_x[k] = direction.x;
        packet.ray.dir_y[k] = direction.y;
        packet.ray.dir_z[k] = direction.z;
    }
    // A face that the sensor lies in, the ground of a robot's frame, say, is met at no distance by
    // all rays along it.
    constexpr float touching_m = 1e-4F;
    std::ranges::fill(packet.ray.tnear, touching_m);
    // Embree also goes as far as lanes reach that are not valid: one ray costs half where they end
    // at once.
    std::ranges::fill(packet.ray.tfar, 0.0F);
    std::fill_n(packet.ray.tfar, count, fan.max_range_m);
    std::ranges::fill(packet.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    std::ranges::fill(packet.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
}

void EmbreeBackend::turn_normals_of_movables(RTCRayHit16& packet) const {
    RTCHit16& hit = packet.hit;
    for (std::size_t k = 0; k < packet_size; ++k) {
        if (hit.instID[0][k] == RTC_INVALID_GEOMETRY_ID) continue;
        const glm::vec3 normal = movables_[hit.instID[0][k]].world_from_model *
                                 glm::vec3{hit.Ng_x[k], hit.Ng_y[k], hit.Ng_z[k]};
        hit.Ng_x[k] = normal.x;
        hit.Ng_y[k] = normal.y;
        hit.Ng_z[k] = normal.z;
    }
}

ObjectId EmbreeBackend::met(const RTCHit16& hit, std::size_t k) const {
    const ModelId model = hit.instID[0][k];
    return model == RTC_INVALID_GEOMETRY_ID ? hit.geomID[k] : bodies_.object(model, hit.geomID[k]);
}

void EmbreeBackend::read(const RTCRayHit16& packet, std::span<Hit> hits) const {
    const RTCRay16& ray = packet.ray;
    const RTCHit16& hit = packet.hit;
    float cosine[packet_size];
    for (std::size_t k = 0; k < packet_size; ++k) {
        const float along =
            hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
        const float length = std::sqrt(hit.Ng_x[k] * hit.Ng_x[k] + hit.Ng_y[k] * hit.Ng_y[k] +
                                       hit.Ng_z[k] * hit.Ng_z[k]);
        cosine[k] = std::min(1.0F, std::abs(along) / length);
    }
    for (std::size_t k = 0; k < hits.size(); ++k) {
        hits[k] = {};
        if (hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        const ObjectId object = met(hit, k);
        hits[k] = {ray.tfar[k], cosine[k], material_of_[object], object};
    }
}

}  // namespace

std::string_view embree_description() {
    return "rays in packets through Embree " RTC_VERSION_STRING;
}

std::unique_ptr<RangeBackend> make_embree_backend(SharedScene scene) {
    return std::make_unique<EmbreeBackend>(std::move(scene));
}

}  // namespace scipd::sim
