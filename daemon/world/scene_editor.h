// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes the scene while scanners run. The new scene is made on the worker's thread and swapped in
// whole, between two scans. An edit that fails changes nothing. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/limits/limits.h"
#include "daemon/world/edited_scene.h"
#include "daemon/world/requested_backend.h"
#include "daemon/world/scene_edit.h"
#include "daemon/world/worker.h"
#include "daemon/world/world.h"
#include "sim/loaders/scene_file.h"

namespace scipd::daemon {

class SceneEditor {
  public:
    /// Tells what the sensors ask for at present.
    using Requests = std::function<std::vector<RequestedBackend>()>;

    /// `world`, `worker` and `clock` must outlive it.
    SceneEditor(World& world, Worker& worker, const Clock& clock, Requests requests,
                SharedLimits limits = std::make_shared<Limits>())
        : world_(world),
          worker_(worker),
          clock_(clock),
          requests_(std::move(requests)),
          limits_(std::move(limits)) {}

    /// Somebody else has loaded the world from this file. Later edits load with the same options,
    /// and read files of these folders alone, and of those in which all worlds find models.
    /// `added` are models of the scene that edits have brought.
    void set_file(std::filesystem::path file, sim::SceneOptions options,
                  std::vector<std::filesystem::path> allow, AddedTriangles added = {}) {
        ++loads_;
        added_ = std::move(added);
        warnings_.clear();
        file_ = std::move(file);
        options_ = std::move(options);
        allow_ = std::move(allow);
    }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    /// How many worlds have been loaded, the same one again or another.
    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    /// There is this to know, too, about the world or what is in it; nothing is told twice.
    void add_warnings(const std::vector<std::string>& warnings);
    /// What there is to know about the world, and about what edits have added to it.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// Takes effect after all edits that were asked for before. `done` is called when the edit is
    /// in effect or refused; it is not called where the edit is withdrawn before it has begun. A
    /// file that is being read then is not read to its end, so that later edits need not wait.
    void edit(SceneEdit edit, EditDone done, std::stop_token withdrawn = {});

  private:
    struct Next;

    void take_up(Next& next);
    void warn_of_lost_bodies(Next& next) const;

    World& world_;
    Worker& worker_;
    const Clock& clock_;
    Requests requests_;
    SharedLimits limits_;
    AddedTriangles added_;
    std::uint64_t loads_ = 0;
    std::filesystem::path file_;
    std::vector<std::string> warnings_;
    sim::SceneOptions options_;
    std::vector<std::filesystem::path> allow_;
};

}  // namespace scipd::daemon
