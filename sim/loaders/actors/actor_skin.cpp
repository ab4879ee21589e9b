// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/actors/actor_skin.h"

#include <cmath>
#include <filesystem>

#include "sim/loaders/file/load_error.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// A person's size, by our choice.
constexpr double height_m = 1.75;
constexpr double radius_m = 0.25;
/// Height of the hips as a share of the body height: Drillis and Contini, Body Segment Parameters
/// (1966).
constexpr double hips_share = 0.53;

Mesh capsule() {
    return capsule_mesh(radius_m, height_m - 2.0 * radius_m);
}

Bounds bounds_of_all(const std::vector<SharedPart>& parts) {
    Bounds bounds;
    for (const SharedPart& part : parts)
        bounds.include(bounds_of(part.mesh), Pose{});
    return bounds;
}

/// Worlds name the skins that come with Gazebo by their file name alone.
fs::path find_skin(const std::string& uri, const fs::path& folder, const Resources& resources) {
    const fs::path found = resources.find(uri, folder);
    return found.empty() ? resources.find("media/models/" + uri, folder) : found;
}

}  // namespace

double lift_m(const Bounds& skin, double actor_z_m) {
    const double feet_m = skin.low_m.z;
    const double size_m = skin.high_m.z - feet_m;
    const bool origin_at_hips = feet_m < -0.25 * size_m;
    const double hips_m = origin_at_hips ? -feet_m : hips_share * size_m;
    const bool stands_there = std::abs(actor_z_m) <= std::abs(actor_z_m - hips_m);
    return -feet_m - (stands_there ? 0.0 : hips_m);
}

ActorSkin skin_of(const NamedFile& file, const MeshView& view, const Resources& resources,
                  MeshShelf& shelf, double actor_z_m) {
    ActorSkin skin;
    const auto& [uri, folder] = file;
    try {
        if (uri.empty()) throw LoadError({"has no <skin>"});
        const fs::path found = find_skin(uri, folder, resources);
        if (found.empty()) throw LoadError({resources.not_found(uri, folder)});
        skin.parts = shelf.parts_of(found, view);
        skin.warning = case_warning(uri, found);
    } catch (const LoadError& error) {
        skin.warning = std::string{error.what()} +
                       "; a capsule of a person's size, 1.75 m high and 0.5 m wide, stands in";
        skin.parts = {{{}, shelf.stand_in(capsule)}};
    }
    skin.lift_m = lift_m(bounds_of_all(skin.parts), actor_z_m);
    return skin;
}

}  // namespace scipd::sim
