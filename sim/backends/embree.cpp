// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All scenes are robust: without, rays that aim at shared edges slip through a few times in a
// million.
#include "sim/backends/embree.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "sim/backends/embree_api.h"
#include "sim/backends/embree_movables.h"
#include "sim/backends/embree_still.h"

namespace scipd::sim {
namespace {

/// One pose as the packets need it: float, relative to the anchor.
struct View {
    View(const Pose& pose, const glm::dvec3& anchor_m)
        : anchored_from_sensor(glm::mat3_cast(glm::quat(pose.rotation))),
          origin_m(pose.translation_m - anchor_m) {}

    glm::mat3 anchored_from_sensor;
    glm::vec3 origin_m;
};

/// The first `count` lanes of a packet.
struct Lanes {
    explicit Lanes(std::size_t count) { std::fill_n(valid, count, -1); }
    alignas(64) int valid[packet_size] = {};
};

class EmbreeBackend final : public RangeBackend {
  public:
    explicit EmbreeBackend(SharedScene shared_scene);

  private:
    void do_move(ModelId model, const Pose& world_from_model) override;
    void do_cast(const Fan& fan, std::span<Hit> hits) override;
    [[nodiscard]] bool casts_apart() const override { return true; }
    void do_cast_moving(const Fan& fan, std::span<Hit> hits) override;
    [[nodiscard]] bool follows_light() const override { return true; }
    void do_cast_with_normals(const Fan& fan, std::span<Hit> hits,
                              std::span<glm::vec3> world_normals) override;
    /// Calls `read(packet, first, count)` for each packet of rays that has been traced.
    template <class Read>
    void trace(const Fan& fan, Read read);

    void aim(const Fan& fan, std::size_t first, std::size_t count, RTCRayHit16& packet) const;
    void read(const RTCRayHit16& packet, std::span<Hit> hits) const;
    /// Leaves hits as they are in front of which nothing was met.
    void read_met(const RTCRayHit16& packet, std::span<Hit> hits) const;
    /// The object that ray k has hit.
    [[nodiscard]] ObjectId met(const RTCHit16& hit, std::size_t k) const;

    std::shared_ptr<const EmbreeStill> still_;
    EmbreeMovables movables_;
    std::vector<MaterialId> material_of_;  ///< by ObjectId
};

EmbreeBackend::EmbreeBackend(SharedScene shared_scene)
    : RangeBackend(shared_scene), still_(still_part(shared_scene)), movables_(shared_scene) {
    for (const Object& object : scene().objects)
        material_of_.push_back(object.material);
}

void EmbreeBackend::do_move(ModelId model, const Pose& world_from_model) {
    movables_.move(model, world_from_model);
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
    movables_.show(fan.can_meet.value_or(movables_.all()));
    CoherentTracer tracer{fan.unseen};
    RTCRayHit16 packet{};
    std::ranges::fill(packet.ray.mask, ~0U);
    const std::size_t rays = fan.directions.size();
    for (std::size_t first = 0; first < rays; first += packet_size) {
        const std::size_t count = std::min(packet_size, rays - first);
        const Lanes lanes(count);
        aim(fan, first, count, packet);
        tracer.trace(lanes.valid, still_->scene.get(), packet);
        movables_.trace(tracer, lanes.valid, packet);
        read(packet, first, count);
    }
}

// The fans of a sweep meet few models, and one that moves several times, each time elsewhere. To
// commit a scene with them takes longer than to trace one after the other.
void EmbreeBackend::do_cast_moving(const Fan& fan, std::span<Hit> hits) {
    const DenormalsAsZero while_casting;
    CoherentTracer tracer{no_model};
    RTCRayHit16 packet{};
    std::ranges::fill(packet.ray.mask, ~0U);
    for (std::size_t first = 0; first < hits.size(); first += packet_size) {
        const std::size_t count = std::min(packet_size, hits.size() - first);
        const std::span<Hit> so_far = hits.subspan(first, count);
        const Lanes lanes(count);
        aim(fan, first, count, packet);
        for (std::size_t k = 0; k < count; ++k)
            packet.ray.tfar[k] = std::min(packet.ray.tfar[k], so_far[k].range_m);
        for (const ModelId model : *fan.can_meet) {
            if (model != fan.unseen) movables_.trace_alone(model, tracer, lanes.valid, packet);
        }
        read_met(packet, so_far);
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

ObjectId EmbreeBackend::met(const RTCHit16& hit, std::size_t k) const {
    const bool stands = hit.instID[0][k] == RTC_INVALID_GEOMETRY_ID;
    return stands ? hit.geomID[k] : movables_.object(hit, k);
}

void EmbreeBackend::read(const RTCRayHit16& packet, std::span<Hit> hits) const {
    std::ranges::fill(hits, Hit{});
    read_met(packet, hits);
}

void EmbreeBackend::read_met(const RTCRayHit16& packet, std::span<Hit> hits) const {
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
