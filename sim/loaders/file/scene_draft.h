// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scene that a loader builds while it walks through a document. It also collects everything
// that is wrong, so that one run reports all faults. Knows nothing of the document's elements. Any
// thread; one owner.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/world/scene.h"

namespace scipd::sim {

class SceneDraft {
  public:
    /// Messages begin with the file. If `strict`, everything left out is a fault.
    SceneDraft(std::filesystem::path file, bool strict, std::vector<std::string> warnings = {});

    void set_name(const std::string& name) { scene_.name = name; }
    ModelId add(Model model);
    /// Takes back the last model if nothing of it could be read.
    void drop_if_bare(ModelId last);
    /// A material without a name is "default".
    void add(Object object, const Material& material);
    /// Frames are large, and a vector that grows takes twice as much.
    void expect_frames(std::size_t count) { scene_.frames.reserve(count); }
    void add(Frame frame) { scene_.frames.push_back(std::move(frame)); }
    [[nodiscard]] const Model& model(ModelId id) const { return scene_.models[id]; }

    /// Adds a warning, unless the same text is there already. Beyond 1000 it counts them.
    void warn(const std::string& text);
    /// Reports something left out that a scanner could have seen.
    void leave_out(const std::string& why);
    /// Like leave_out(), for what the user can do nothing about. Here it is a warning even in a
    /// strict load; load_sdf() then turns all warnings of a strict load into faults.
    void pass_over(const std::string& why);
    /// Reports a fault that refuses the whole scene.
    void refuse(const std::string& why);

    /// Throws LoadError if anything is refused, or if the scene is empty because everything was
    /// left out. `what_is_seen` names the element that holds the geometry.
    LoadedScene finish(const std::string& what_is_seen) &&;

  private:
    std::filesystem::path file_;
    bool strict_;
    Scene scene_;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    std::unordered_set<std::string> told_;  ///< all of the warnings
    std::size_t more_ = 0;                  ///< warnings that are not told
    bool anything_left_out_ = false;
};

}  // namespace scipd::sim
