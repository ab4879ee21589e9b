// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/backend_chooser.h"

#include <algorithm>
#include <stdexcept>

#include <spdlog/spdlog.h>

namespace scipd::daemon {

void BackendChooser::choose() {
    if (!std::exchange(busy_, true)) step();
}

// Behind whatever has been asked of the loader meanwhile.
void BackendChooser::step() {
    loader_.add([this] { return next(); });
}

Loader::Work BackendChooser::next() {
    if (!measured_.workshop || measured_.workshop->scene() != world_.scene()) {
        end();
        busy_ = true;
        measured_.workshop = std::make_shared<BackendWorkshop>(world_.scene());
    }
    std::vector<BackendWish> wishes = wishes_();
    for (BackendWish& wish : wishes) {
        const auto known = measured_.choices.find(wish.sensor);
        if (known != measured_.choices.end()) wish.settled = known->second;
    }
    const auto open = std::ranges::find_if(
        wishes, [&](const BackendWish& wish) { return measured_.workshop->is_open(wish); });
    return open != wishes.end() ? measure(std::move(*open)) : take_up(std::move(wishes));
}

Loader::Work BackendChooser::measure(BackendWish wish) {
    return [this, workshop = measured_.workshop, wish = std::move(wish),
            stopping = loader_.stopping()]() -> Loader::Finish {
        const auto ended = [&] { return stopping.stop_requested(); };
        const SharedChoice choice = workshop->measure(wish, ended);
        return [this, workshop, sensor = wish.sensor, choice] {
            measured_.choices[sensor] = choice;
            step();
        };
    };
}

Loader::Work BackendChooser::take_up(std::vector<BackendWish> wishes) {
    if (measured_.choices.empty()) return [this] { return [this] { end(); }; };
    return [this, workshop = measured_.workshop, wishes = std::move(wishes)]() -> Loader::Finish {
        const auto chosen = std::make_shared<SensorBackends>();
        try {
            *chosen = workshop->make(wishes);
        } catch (const std::runtime_error& error) {
            return [this, why = std::string(error.what())] {
                spdlog::warn("backends stay as they are: {}", why);
                end();
            };
        }
        return [this, chosen] {
            *chosen = world_.replace_backends(std::move(*chosen));
            loader_.discard(chosen);
            end();
        };
    };
}

void BackendChooser::end() {
    busy_ = false;
    measured_.choices.clear();
    loader_.discard(std::exchange(measured_.workshop, nullptr));
}

}  // namespace scipd::daemon
