// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds out which backend `auto` takes for each sensor, by measuring on the worker's thread. It
// measures while no client of a scanner is connected, and stops when one comes. It measures one
// sensor at a time, so that other work waits for one sensor and not for all. Sensors that ask alike
// are measured once, where the first of them is. What was measured in a scene that has been
// replaced meanwhile does not count. Lives on the I/O thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/world/backend_maker.h"
#include "daemon/world/worker.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class BackendChooser {
  public:
    /// Tells what the sensors ask for at present, and what is settled already.
    using Requests = std::function<std::vector<RequestedBackend>()>;

    /// All must outlive it. `clients` counts the clients of all scanners.
    BackendChooser(World& world, Worker& worker, Clock& clock, const std::atomic<int>& clients,
                   Requests requests)
        : world_(world),
          worker_(worker),
          clock_(clock),
          clients_(clients),
          requests_(std::move(requests)),
          alarm_(clock.make_alarm()) {}

    /// To be called when a sensor may need measuring: after other sensors or another scene came.
    void choose();
    void stop() { alarm_->cancel(); }

  private:
    struct Answer {
        RequestedBackend request;
        SharedChoice choice;
    };
    struct Measured {
        std::shared_ptr<BackendMaker> maker;  ///< for the scene; null: nothing is measured
        std::vector<Answer> answers;
    };

    /// Begins once no client was there on this many more looks.
    void wait(int looks);
    /// Begins anew: a client has come.
    void put_off();
    void step();
    /// Measures one sensor that is open. Where none is, makes backends for all.
    Worker::Work next();
    Worker::Work measure(RequestedBackend request);
    Worker::Work take_up(std::vector<RequestedBackend> requests);
    void end();

    World& world_;
    Worker& worker_;
    Clock& clock_;
    const std::atomic<int>& clients_;
    Requests requests_;
    std::unique_ptr<Clock::Alarm> alarm_;
    bool busy_ = false;
    Measured measured_;
};

}  // namespace scipd::daemon
