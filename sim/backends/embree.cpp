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

/// A face that the sensor lies in, the ground of a robot's frame, say, is met at no distance by all
/// rays along it.
constexpr float touching_m = 1e-4F;

/// One pose as the packets need it: float, relative to the anchor.
struct View {
    View(const Pose& pose, const glm::dvec3& anchor_m)
        : anchored_from_sensor(glm::mat3_cast(glm::quat(pose.rotation))),
          origin_m(pose.translation_m - anchor_m) {}

    glm::mat3 anchored_from_sensor;
    glm::vec3 origin_m;
};

/// Aims the rays of a fan in its order, packet after packet. In its loops the compiler takes many
/// rays at once: one by one, those of a scanner that moves took twice the time. What all packets
/// share is written once, since tracing leaves it alone.
class Aim {
  public:
    /// `packet` is the one that is filled, and outlives it.
    Aim(const Fan& fan, const glm::dvec3& anchor_m, RTCRayHit16& packet);

    /// `first` is where the call before ended.
    void fill(std::size_t first, std::size_t count);

  private:
    void point_from_one_pose(std::size_t first, std::size_t count);
    void point_from_few_poses(std::size_t first, std::size_t count);
    void point_from_own_poses(std::size_t first, std::size_t count);
    void place(std::size_t k, const glm::vec3& origin_m) {
        ray_.org_x[k] = origin_m.x;
        ray_.org_y[k] = origin_m.y;
        ray_.org_z[k] = origin_m.z;
    }
    void direct(std::size_t k, const glm::vec3& direction) {
        ray_.dir_x[k] = direction.x;
        ray_.dir_y[k] = direction.y;
        ray_.dir_z[k] = direction.z;
    }

    const Fan& fan_;
    const glm::dvec3& anchor_m_;
    RTCRayHit16& packet_;
    RTCRay16& ray_;
    View view_;
    std::size_t pose_ = 0;  ///< of view_
};

Aim::Aim(const Fan& fan, const glm::dvec3& anchor_m, RTCRayHit16& packet)
    : fan_(fan),
      anchor_m_(anchor_m),
      packet_(packet),
      ray_(packet.ray),
      view_(fan.world_from_sensor.front(), anchor_m) {
    std::ranges::fill(ray_.tnear, touching_m);
    std::ranges::fill(ray_.mask, ~0U);
    for (std::size_t k = 0; k < packet_size; ++k)
        place(k, view_.origin_m);
}

void Aim::point_from_one_pose(std::size_t first, std::size_t count) {
    const glm::mat3 anchored_from_sensor = view_.anchored_from_sensor;
    for (std::size_t k = 0; k < count; ++k)
        direct(k, anchored_from_sensor * fan_.directions[first + k]);
}

/// A pose is made ready once for all rays that it has.
void Aim::point_from_few_poses(std::size_t first, std::size_t count) {
    std::size_t end = (pose_ + 1) * fan_.directions_per_pose;
    for (std::size_t k = 0; k < count; ++k) {
        if (first + k == end) {
            view_ = View{fan_.world_from_sensor[++pose_], anchor_m_};
            end += fan_.directions_per_pose;
        }
        place(k, view_.origin_m);
        direct(k, view_.anchored_from_sensor * fan_.directions[first + k]);
    }
}

void Aim::point_from_own_poses(std::size_t first, std::size_t count) {
    float x[packet_size];
    float y[packet_size];
    float z[packet_size];
    float w[packet_size];
    for (std::size_t k = 0; k < count; ++k) {
        const Pose& pose = fan_.world_from_sensor[first + k];
        const glm::quat rotation(pose.rotation);
        place(k, glm::vec3(pose.translation_m - anchor_m_));
        x[k] = rotation.x;
        y[k] = rotation.y;
        z[k] = rotation.z;
        w[k] = rotation.w;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const glm::mat3 anchored_from_sensor = glm::mat3_cast(glm::quat(w[k], x[k], y[k], z[k]));
        direct(k, anchored_from_sensor * fan_.directions[first + k]);
    }
}

void Aim::fill(std::size_t first, std::size_t count) {
    if (fan_.world_from_sensor.size() == 1)
        point_from_one_pose(first, count);
    else if (fan_.directions_per_pose == 1)
        point_from_own_poses(first, count);
    else
        point_from_few_poses(first, count);
    for (auto* const components : {&ray_.dir_x, &ray_.dir_y, &ray_.dir_z})
        std::ranges::transform(*components, *components, component_apart_from_zero);
    // Embree also goes as far as lanes reach that are not valid: one ray costs half where they end
    // at once.
    std::ranges::fill(ray_.tfar, 0.0F);
    std::fill_n(ray_.tfar, count, fan_.max_range_m);
    std::ranges::fill(packet_.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    std::ranges::fill(packet_.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
}

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

    /// Calls `trace(valid)`, and calls it again for the lanes that have met one of these objects,
    /// whose rays then begin behind it, until none has.
    template <class Trace>
    void trace_behind(std::span<const ObjectId> objects, Lanes lanes, RTCRayHit16& packet,
                      Trace trace) const;

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
    if (fan.directions.empty()) return;
    const DenormalsAsZero while_casting;
    movables_.show(fan.can_meet.value_or(movables_.all()));
    CoherentTracer tracer{fan.unseen.model};
    RTCRayHit16 packet{};
    Aim aim(fan, scene().anchor_m, packet);
    const std::size_t rays = fan.directions.size();
    for (std::size_t first = 0; first < rays; first += packet_size) {
        const std::size_t count = std::min(packet_size, rays - first);
        const Lanes lanes(count);
        aim.fill(first, count);
        trace_behind(fan.unseen.objects, lanes, packet, [&](const int* valid) {
            tracer.trace(valid, still_->scene.get(), packet);
            movables_.trace(tracer, valid, packet);
        });
        read(packet, first, count);
    }
}

// A filter on the faces of all objects would slow every ray down. This costs those alone that a
// housing surrounds.
template <class Trace>
void EmbreeBackend::trace_behind(std::span<const ObjectId> objects, Lanes lanes,
                                 RTCRayHit16& packet, Trace trace) const {
    if (objects.empty()) return trace(lanes.valid);
    const RTCRayHit16 before = packet;
    const auto met_one = [&](std::size_t k) {
        return lanes.valid[k] != 0 && packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID &&
               std::ranges::find(objects, met(packet.hit, k)) != objects.end();
    };
    for (bool again = true; again;) {
        trace(lanes.valid);
        again = false;
        for (std::size_t k = 0; k < packet_size; ++k) {
            lanes.valid[k] = met_one(k) ? -1 : 0;
            if (lanes.valid[k] == 0) continue;
            again = true;
            // The next float would not do: Embree may find the same face again.
            constexpr float farther = 1.0F + 1e-6F;
            packet.ray.tnear[k] = farther * packet.ray.tfar[k] + touching_m;
            packet.ray.tfar[k] = before.ray.tfar[k];
            packet.hit.Ng_x[k] = before.hit.Ng_x[k];
            packet.hit.Ng_y[k] = before.hit.Ng_y[k];
            packet.hit.Ng_z[k] = before.hit.Ng_z[k];
            packet.hit.geomID[k] = before.hit.geomID[k];
            packet.hit.instID[0][k] = before.hit.instID[0][k];
            if (packet.ray.tnear[k] >= packet.ray.tfar[k]) lanes.valid[k] = 0;
        }
    }
    std::ranges::fill(packet.ray.tnear, touching_m);
}

// The fans of a sweep meet few models, and one that moves several times, each time elsewhere. To
// commit a scene with them takes longer than to trace one after the other.
void EmbreeBackend::do_cast_moving(const Fan& fan, std::span<Hit> hits) {
    if (fan.directions.empty()) return;
    const DenormalsAsZero while_casting;
    CoherentTracer tracer{no_model};
    RTCRayHit16 packet{};
    Aim aim(fan, scene().anchor_m, packet);
    for (std::size_t first = 0; first < hits.size(); first += packet_size) {
        const std::size_t count = std::min(packet_size, hits.size() - first);
        const std::span<Hit> so_far = hits.subspan(first, count);
        const Lanes lanes(count);
        aim.fill(first, count);
        for (std::size_t k = 0; k < count; ++k)
            packet.ray.tfar[k] = std::min(packet.ray.tfar[k], so_far[k].range_m);
        for (const ModelId model : *fan.can_meet) {
            if (model == fan.unseen.model) continue;
            trace_behind(fan.unseen.objects, lanes, packet, [&](const int* valid) {
                movables_.trace_alone(model, tracer, valid, packet);
            });
        }
        read_met(packet, so_far);
    }
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
