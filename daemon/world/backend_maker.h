// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes backends for one scene, each when it is first asked for, and measures which of them is the
// fastest for a sensor that leaves the choice to `auto`. Made and used on any thread, one at a
// time.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "daemon/world/backend_choice.h"
#include "daemon/world/requested_backend.h"
#include "daemon/world/sensor_backends.h"
#include "sim/backends/backend_row.h"

namespace scipd::daemon {

class BackendMaker {
  public:
    explicit BackendMaker(sim::SharedScene scene);

    [[nodiscard]] const sim::SharedScene& scene() const { return scene_; }
    /// Whether it is `auto` and was not measured yet, or was measured in a scene unlike this one.
    [[nodiscard]] bool is_open(const RequestedBackend& request) const;
    /// Takes about half a second at most; for `ended` see sim::ChoiceLimits: then this returns
    /// null. No backend is bound to a thread when this returns.
    SharedChoice measure(const RequestedBackend& request, const std::function<bool()>& ended);
    /// Does what make_backends() says.
    SensorBackends make(std::span<const RequestedBackend> requests);

  private:
    using SharedBackend = std::shared_ptr<sim::RangeBackend>;
    /// The backend's name, all of DepthOptions, and the shard.
    using MadeKey = std::tuple<std::string_view, sim::BetweenPixels, double, double, std::size_t>;

    void make(const RequestedBackend& request, SensorBackends& backends);
    SharedBackend backend(const sim::BackendRow& row, const RequestedBackend& request);
    [[nodiscard]] SharedChoice settled(const RequestedBackend& request);
    /// Whether the sensor sees light that only rays follow.
    [[nodiscard]] bool needs_rays(const RequestedBackend& request) const;
    /// Reason why `auto` does not draw this scene; empty where it may.
    [[nodiscard]] std::string too_large(const sim::BackendRow& row) const;
    BackendChoice fastest(const RequestedBackend& request, const std::function<bool()>& ended);
    void leave_thread();

    sim::SharedScene scene_;
    std::size_t faces_;
    double triangles_ = 0.0;  ///< of all that a backend would draw, about
    std::map<MadeKey, SharedBackend> made_;
};

/// Measures nothing: for `auto` it takes what has been settled, else the preferred backend. No
/// backend is bound to a thread when this returns. Throws std::runtime_error where a backend that
/// was asked for by name cannot be had on this machine.
SensorBackends make_backends(std::span<const RequestedBackend> requests,
                             const sim::SharedScene& scene);

}  // namespace scipd::daemon
