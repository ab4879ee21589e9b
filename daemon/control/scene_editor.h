// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes the scene while scanners run: another one is made on the loader's thread and swapped in
// whole, between two scans. What fails changes nothing. Lives on the I/O thread.
#pragma once

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "daemon/control/loader.h"
#include "daemon/control/scene_edit.h"
#include "daemon/control/world.h"
#include "sim/loaders/sdf.h"

namespace scipd::daemon {

class SceneEditor {
  public:
    /// Loads a world; on the loader's thread. Throws LoadError.
    using LoadFile = std::function<sim::LoadedScene(const std::filesystem::path&)>;
    /// What the sensors ask for at present.
    using Wishes = std::function<std::vector<BackendWish>()>;

    /// `world` and `loader` must outlive it.
    SceneEditor(World& world, Loader& loader, LoadFile load, Wishes wishes)
        : world_(world), loader_(loader), load_(std::move(load)), wishes_(std::move(wishes)) {}

    /// The world has been loaded from there by somebody else.
    void set_file(std::filesystem::path file) { file_ = std::move(file); }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// After all that was asked for before; `done` is called when it is in effect or refused.
    void edit(SceneEdit edit, EditDone done);

  private:
    struct Next;

    void take_up(Next& next);

    World& world_;
    Loader& loader_;
    LoadFile load_;
    Wishes wishes_;
    std::filesystem::path file_;
};

}  // namespace scipd::daemon
