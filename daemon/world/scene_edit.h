// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A change of the scene that somebody asks for, and what became of it. Values; no thread rule.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "daemon/limits/limit.h"
#include "sim/loaders/file/new_model.h"

namespace scipd::daemon {

/// Another world in place of this one, with everything where its file has it.
struct LoadWorld {
    std::filesystem::path file;  ///< relative to the folder of the present one
};

/// One more model, from a text, a file, a mesh, or the bytes of a mesh: one of these is given.
/// Paths, and URIs in the text, are relative to the folder of the world.
struct AddModel {
    sim::Placement placement;
    std::string sdf;             ///< a <model>
    std::filesystem::path file;  ///< of any kind that a world may be of, or the folder of a model
    std::filesystem::path mesh;
    std::string mesh_data;    ///< in base64
    std::string mesh_format;  ///< of these bytes, as the name of their file would end: "stl"
    double scale = 1.0;       ///< of a mesh
    std::string material;     ///< of a whole mesh; empty: those of its file
    bool replace = false;     ///< it takes the place of a model of the same name
    std::vector<std::string> warnings = {};  ///< about what was asked for
};

struct RemoveModel {
    std::string name;
};

/// The objects of a model, and of those that lie in it, get other materials: all the same one, or
/// each its own, in their order in the scene.
struct SetMaterial {
    std::string model;
    std::vector<std::string> materials;
};

using SceneEdit = std::variant<LoadWorld, AddModel, RemoveModel, SetMaterial>;

/// That it adds or takes away; else empty.
inline std::string model_of(const SceneEdit& edit) {
    if (const auto* const add = std::get_if<AddModel>(&edit)) return add->placement.name;
    if (const auto* const remove = std::get_if<RemoveModel>(&edit)) return remove->name;
    return {};
}

struct EditOutcome {
    enum class Result {
        done,
        faulty,     ///< it cannot be loaded
        forbidden,  ///< its file lies where nobody may have files read
        unknown,    ///< no such model
        taken,      ///< there is a model of this name
        too_much,   ///< `limit` says of what
        not_now,    ///< the world is shared, and the others cannot be told
    };
    Result result = Result::done;
    /// Warnings where it is done; else why not.
    std::vector<std::string> messages;
    /// What is worth knowing where it is done, and no warning.
    std::vector<std::string> notes = {};
    Limit limit = {};
};

inline std::string in_one_line(const std::vector<std::string>& messages) {
    std::string text;
    for (const std::string& message : messages)
        text += (text.empty() ? "" : "; ") + message;
    return text;
}

using EditDone = std::function<void(const EditOutcome&)>;

}  // namespace scipd::daemon
