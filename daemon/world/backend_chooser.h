// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Settles "auto" by measuring, on the loader's thread: one sensor after the other, so that whoever
// wants the loader meanwhile waits for one sensor and not for all. What was measured in a scene
// that is no longer there does not count. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "daemon/world/backend_workshop.h"
#include "daemon/world/loader.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class BackendChooser {
  public:
    /// What the sensors ask for at present, and what is settled.
    using Wishes = std::function<std::vector<BackendWish>()>;

    /// `world` and `loader` must outlive it.
    BackendChooser(World& world, Loader& loader, Wishes wishes)
        : world_(world), loader_(loader), wishes_(std::move(wishes)) {}

    /// To be called when anything may be open: other sensors, another scene.
    void choose();

  private:
    /// Null workshop: of no scene.
    struct Measured {
        std::shared_ptr<BackendWorkshop> workshop;
        std::map<std::string, SharedChoice> choices;  ///< by sensor
    };

    void step();
    /// Of one sensor that is open; when none is any more, backends for all.
    Loader::Work next();
    Loader::Work measure(BackendWish wish);
    Loader::Work take_up(std::vector<BackendWish> wishes);
    void end();

    World& world_;
    Loader& loader_;
    Wishes wishes_;
    bool busy_ = false;
    Measured measured_;
};

}  // namespace scipd::daemon
