// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Backends for one scene, each made when it is first asked for, and what "auto" is settled by:
// measuring those of them that contend. Made and used on any thread, one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>

#include "daemon/world/sensor_backends.h"

namespace scipd::daemon {

class BackendWorkshop {
  public:
    explicit BackendWorkshop(sim::SharedScene scene);

    [[nodiscard]] const sim::SharedScene& scene() const { return scene_; }
    /// Whether it is "auto" that has not been measured yet, or in a scene unlike this one.
    [[nodiscard]] bool is_open(const BackendWish& wish) const;
    /// Takes about half a second at most; `ended` as ChoiceLimits has it. Bound to no thread when
    /// this returns.
    SharedChoice measure(const BackendWish& wish, const std::function<bool()>& ended);
    /// As make_backends().
    SensorBackends make(std::span<const BackendWish> wishes);

  private:
    using SharedBackend = std::shared_ptr<sim::RangeBackend>;
    using Kind = std::tuple<std::string, sim::BetweenPixels, double, double>;

    SharedBackend backend(const std::string& name, const sim::DepthOptions& options);
    [[nodiscard]] SharedChoice settled(const BackendWish& wish);
    BackendChoice fastest(const BackendWish& wish, const std::function<bool()>& ended);
    void leave_thread();

    sim::SharedScene scene_;
    std::size_t faces_;
    std::map<Kind, SharedBackend> made_;
};

}  // namespace scipd::daemon
