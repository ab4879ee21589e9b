// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backend casts for which sensor, in one scene. Sensors of a shard that ask for the same
// share one. Made on any thread (BackendMaker); those of a shard are used on one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/world/backend_choice.h"
#include "sim/backends/range_backend.h"

namespace scipd::daemon {

class SensorBackends {
  public:
    void assign(const std::string& sensor, std::shared_ptr<sim::RangeBackend> backend,
                SharedChoice choice, std::size_t shard = 0);

    /// Those of the sensors that live there.
    [[nodiscard]] SensorBackends of_shard(std::size_t shard) const;

    // Both want the name of a sensor that a backend was assigned to.
    [[nodiscard]] sim::RangeBackend& of(std::string_view sensor) {
        return *sensors_.find(sensor)->second.backend;
    }
    [[nodiscard]] const SharedChoice& choice_of(std::string_view sensor) const {
        return sensors_.find(sensor)->second.choice;
    }

    /// Logs for which sensors `auto` was measured again, and what it takes now.
    void log_changes_since(const SensorBackends& before) const;

    /// See RangeBackend::leave_thread().
    void leave_thread();

  private:
    struct Assigned {
        std::shared_ptr<sim::RangeBackend> backend;
        SharedChoice choice;
        std::size_t shard = 0;
    };

    std::vector<sim::RangeBackend*> backends_;  ///< each once
    std::map<std::string, Assigned, std::less<>> sensors_;
};

}  // namespace scipd::daemon
