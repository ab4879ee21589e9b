// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scene while an SDF document is walked through: what was found so far, and everything that is
// wrong, so that one run tells all. Knows nothing of SDF's elements. Any thread; one owner.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/world/scene.h"

namespace scipd::sim {

class SceneDraft {
  public:
    /// Messages begin with the file; `strict` makes all that is left out a fault.
    SceneDraft(std::filesystem::path file, bool strict, std::vector<std::string> warnings);

    void set_name(const std::string& name) { scene_.name = name; }
    ModelId add(Model model);
    /// A material without a name is "default".
    void add(Object object, const Material& material);
    void add(Frame frame) { scene_.frames.push_back(std::move(frame)); }
    [[nodiscard]] const Model& model(ModelId id) const { return scene_.models[id]; }

    /// Each once.
    void warn(std::string text);
    /// Something that a scanner could have seen.
    void leave_out(const std::string& why);
    /// The same, where the user can do nothing about it: a warning even of a strict load, which
    /// makes a fault of it in the end.
    void pass_over(std::string why);
    /// Nothing is left to be loaded.
    void refuse(std::string why) { faults_.push_back(std::move(why)); }

    /// Throws LoadError where anything is refused, or where nothing is there because all was left
    /// out. `what_is_seen` names the element that geometry is read from.
    LoadedScene finish(const std::string& what_is_seen) &&;

  private:
    MaterialId id_of(const Material& material);
    void show_names();

    std::filesystem::path file_;
    bool strict_;
    Scene scene_;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    bool anything_left_out_ = false;
};

}  // namespace scipd::sim
