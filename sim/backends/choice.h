// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backend casts a sensor's fans fastest on this machine and in this scene: all contenders
// cast them for a short time, and the fastest one that agrees with the first is taken. Reads no
// clock: the time is handed in. Lives on the thread of the backends.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "sim/backends/range_backend.h"
#include "sim/time.h"

namespace scipd::sim {

struct Contender {
    std::string name;
    /// May throw std::runtime_error where this machine cannot have it.
    std::function<std::unique_ptr<RangeBackend>()> make;
};

struct Choice {
    std::unique_ptr<RangeBackend> backend;
    /// For the log: what each took for a fan, or why it is out of the question.
    std::string reason;
};

/// `fans` are as the sensor casts them, with as many different poses; at least one. The first
/// contender is the yardstick and must be had: what it throws is thrown.
Choice choose(std::span<const Contender> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now);

/// Between rays and a depth buffer. Making the latter ready takes a tenth of a second.
Choice choose_backend(const SharedScene& scene, std::span<const Fan> fans,
                      const std::function<Time()>& now);

}  // namespace scipd::sim
