// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds out which backend `auto` takes for each sensor, by measuring on the worker's thread. It
// measures one sensor at a time, so that other work waits for one sensor and not for all. Sensors
// that ask alike are measured once, where the first of them is. What was measured in a scene that
// has been replaced meanwhile does not count. Lives on the I/O thread.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/world/backend_maker.h"
#include "daemon/world/worker.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class BackendChooser {
  public:
    /// Tells what the sensors ask for at present, and what is settled already.
    using Requests = std::function<std::vector<RequestedBackend>()>;

    /// `world` and `worker` must outlive it.
    BackendChooser(World& world, Worker& worker, Requests requests)
        : world_(world), worker_(worker), requests_(std::move(requests)) {}

    /// To be called when a sensor may need measuring: after other sensors or another scene came.
    void choose();

  private:
    struct Answer {
        RequestedBackend request;
        SharedChoice choice;
    };
    struct Measured {
        std::shared_ptr<BackendMaker> maker;  ///< for the scene; null: nothing is measured
        std::vector<Answer> answers;
    };

    void step();
    /// Measures one sensor that is open. Where none is, makes backends for all.
    Worker::Work next();
    Worker::Work measure(RequestedBackend request);
    Worker::Work take_up(std::vector<RequestedBackend> requests);
    void end();

    World& world_;
    Worker& worker_;
    Requests requests_;
    bool busy_ = false;
    Measured measured_;
};

}  // namespace scipd::daemon
