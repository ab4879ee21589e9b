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

// Queues behind all that the worker has been asked for meanwhile.
void BackendChooser::step() {
    worker_.add([this] { return next(); });
}

Worker::Work BackendChooser::next() {
    if (!measured_.maker || measured_.maker->scene() != world_.scene()) {
        end();
        busy_ = true;
        measured_.maker = std::make_shared<BackendMaker>(world_.scene());
    }
    std::vector<RequestedBackend> requests = requests_();
    for (RequestedBackend& request : requests) {
        if (!measured_.maker->is_open(request)) continue;
        const auto known = std::ranges::find_if(measured_.answers, [&](const Answer& answer) {
            return ask_alike(answer.request, request);
        });
        if (known != measured_.answers.end()) request.settled = known->choice;
    }
    const auto open = std::ranges::find_if(requests, [&](const RequestedBackend& request) {
        return measured_.maker->is_open(request);
    });
    return open != requests.end() ? measure(std::move(*open)) : take_up(std::move(requests));
}

Worker::Work BackendChooser::measure(RequestedBackend request) {
    return [this, maker = measured_.maker, request = std::move(request),
            stopping = worker_.stopping()]() -> Worker::Finish {
        const auto ended = [&] { return stopping.stop_requested(); };
        const SharedChoice choice = maker->measure(request, ended);
        return [this, maker, request, choice] {
            measured_.answers.push_back({request, choice});
            step();
        };
    };
}

Worker::Work BackendChooser::take_up(std::vector<RequestedBackend> requests) {
    if (measured_.answers.empty()) return [this] { return [this] { end(); }; };
    return [this, maker = measured_.maker, requests = std::move(requests)]() -> Worker::Finish {
        const auto chosen = std::make_shared<SensorBackends>();
        try {
            *chosen = maker->make(requests);
        } catch (const std::runtime_error& error) {
            return [this, why = std::string(error.what())] {
                spdlog::warn("backends stay as they are: {}", why);
                end();
            };
        }
        return [this, chosen] {
            *chosen = world_.replace_backends(std::move(*chosen));
            worker_.discard(chosen);
            end();
        };
    };
}

void BackendChooser::end() {
    busy_ = false;
    measured_.answers.clear();
    worker_.discard(std::exchange(measured_.maker, nullptr));
}

}  // namespace scipd::daemon
