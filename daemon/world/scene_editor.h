// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes the scene while scanners run: another one is made on the loader's thread and swapped in
// whole, between two scans. What fails changes nothing. Lives on the I/O thread.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/world/loader.h"
#include "daemon/world/scene_edit.h"
#include "daemon/world/world.h"
#include "sim/loaders/scene_file.h"

namespace scipd::daemon {

class SceneEditor {
  public:
    /// What the sensors ask for at present.
    using Wishes = std::function<std::vector<BackendWish>()>;

    /// All but the wishes must outlive it.
    SceneEditor(World& world, Loader& loader, const Clock& clock, Wishes wishes)
        : world_(world), loader_(loader), clock_(clock), wishes_(std::move(wishes)) {}

    /// The world has been loaded from there by somebody else, and all that comes is to be loaded in
    /// the same way.
    void set_file(std::filesystem::path file, sim::SceneOptions options) {
        file_ = std::move(file);
        options_ = std::move(options);
    }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// After all that was asked for before; `done` is called when it is in effect or refused, and
    /// never where it is withdrawn before it has begun.
    void edit(SceneEdit edit, EditDone done, std::stop_token withdrawn = {});

  private:
    struct Next;

    void take_up(Next& next);
    void warn_of_lost_bodies(Next& next) const;

    World& world_;
    Loader& loader_;
    const Clock& clock_;
    Wishes wishes_;
    std::filesystem::path file_;
    sim::SceneOptions options_;
};

}  // namespace scipd::daemon
