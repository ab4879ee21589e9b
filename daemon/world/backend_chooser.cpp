// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/backend_chooser.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

// A driver that is started together with scipd connects before the second look.
constexpr auto look_every = std::chrono::milliseconds(500);
constexpr int looks_without_client = 2;

}  // namespace

void BackendChooser::choose() {
    if (!std::exchange(busy_, true)) wait(looks_without_client);
}

void BackendChooser::wait(int looks) {
    if (clients_ > 0) looks = looks_without_client;
    if (looks == 0) return step();
    alarm_->set(clock_.now() + look_every, [this, looks] { wait(looks - 1); });
}

void BackendChooser::put_off() {
    end();
    choose();
}

// Queues behind all that the worker has been asked for meanwhile.
void BackendChooser::step() {
    worker_.add([this] { return next(); });
}

Worker::Work BackendChooser::next() {
    if (clients_ > 0) return [this] { return [this] { put_off(); }; };
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
    return [this, maker = measured_.maker, request = std::move(request), &clients = clients_,
            stopping = worker_.stopping()]() -> Worker::Finish {
        const auto ended = [&] { return stopping.stop_requested() || clients > 0; };
        const SharedChoice choice = maker->measure(request, ended);
        if (!choice) return [this] { put_off(); };
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
