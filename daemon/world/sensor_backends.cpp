// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/sensor_backends.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

namespace scipd::daemon {

void SensorBackends::assign(const std::string& sensor, std::shared_ptr<sim::RangeBackend> backend,
                            SharedChoice choice, std::size_t shard) {
    if (std::ranges::find(backends_, backend.get()) == backends_.end())
        backends_.push_back(backend.get());
    sensors_[sensor] = {std::move(backend), std::move(choice), shard};
}

SensorBackends SensorBackends::of_shard(std::size_t shard) const {
    SensorBackends some;
    for (const auto& [sensor, assigned] : sensors_) {
        if (assigned.shard == shard) some.assign(sensor, assigned.backend, assigned.choice, shard);
    }
    return some;
}

void SensorBackends::log_changes_since(const SensorBackends& before) const {
    for (const auto& [sensor, assigned] : sensors_) {
        const BackendChoice& choice = *assigned.choice;
        const auto known = before.sensors_.find(sensor);
        const bool known_choice =
            known != before.sensors_.end() && known->second.choice == assigned.choice;
        if (known_choice || !choice.faces) continue;
        spdlog::info("{}: backend {} chosen ({})", sensor, choice.backend, choice.reason);
    }
}

void SensorBackends::leave_thread() {
    for (sim::RangeBackend* backend : backends_)
        backend->leave_thread();
}

}  // namespace scipd::daemon
