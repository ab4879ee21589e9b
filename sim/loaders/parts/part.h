// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world, a model or a robot as its files say it: a plain tree of parts, with the place of each in
// the files. frames.h tells where the parts lie. Values.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/resources/resources.h"
#include "sim/loaders/terrain/terrain.h"
#include "sim/world/lidar.h"
#include "sim/world/material.h"
#include "sim/world/pose.h"
#include "sim/world/script.h"
#include "sim/world/shape.h"

namespace scipd::sim {

struct FilePlace {
    std::shared_ptr<const std::filesystem::path> file;
    int line = 0;
};

/// FILE:LINE
inline std::string text_of(const FilePlace& place) {
    return place.file->string() + ':' + std::to_string(place.line);
}

/// A pose as a file gives it.
struct GivenPose {
    Pose pose = {};
    std::string relative_to = {};  ///< empty: to what its kind of part lies in by default
};

/// A shape and its pose in the frame of the geometry. The pose is needed because scipd's planes are
/// normal to z, while SDF's may have any normal.
struct PlacedShape {
    Shape shape;
    Pose geometry_from_shape;
};

struct NamedMesh {
    NamedFile file;
    MeshView view;
};

struct NamedHeights {
    NamedFile file;
    TerrainView view;
};

struct NoShape {
    bool is_meant = false;  ///< it is <empty>
};

/// A kind of geometry that scipd does not know.
struct UnknownShape {
    std::string kind;
};

/// A geometry that cannot be read.
struct Unread {
    std::string why;
};

using Geometry = std::variant<NoShape, PlacedShape, NamedMesh, NamedHeights, UnknownShape, Unread>;

/// A visual or a collision. Its pose is relative to its link by default.
struct SdfSurface {
    std::string name;
    FilePlace place;
    GivenPose pose = {};
    Geometry geometry = NoShape{};
    std::string material = {};  ///< empty: none is named
    bool from_script = false;   ///< Material::from_script
    std::optional<double> laser_retro = std::nullopt;
    Appearance appearance = {};
};

struct FoundSensor {
    std::string type;
    std::optional<Lidar> lidar;  ///< if it is a lidar
};

/// What makes a model an actor.
struct Actor {
    Pose pose = {};                                ///< from its own element
    SharedScript script = nullptr;                 ///< null: it stands still
    std::optional<NamedMesh> skin = std::nullopt;  ///< none: its links are what is seen
};

struct SdfPart {
    enum class Kind { world, model, link, frame, joint };

    Kind kind = Kind::model;
    std::string name = {};
    FilePlace place = {};
    GivenPose pose = {};
    /// What a frame is fixed to, empty: the model; or the child of a joint.
    std::string attached_to = {};
    std::vector<SdfPart> parts = {};  ///< of a world or a model

    // What only a model has.
    std::optional<bool> is_static = std::nullopt;
    std::string placement_frame = {};
    std::string canonical_link = {};
    std::shared_ptr<const Actor> actor = nullptr;
    bool is_road = false;  ///< nobody cares what it is called

    // What only a link has.
    std::vector<SdfSurface> surfaces = {};
    bool has_unseen = false;  ///< surfaces of the other kind

    // What only a frame has.
    std::shared_ptr<const FoundSensor> sensor = nullptr;
};

}  // namespace scipd::sim
