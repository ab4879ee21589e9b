// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy_recording.h"

#include <chrono>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "sim/recording/create_recording.h"

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

// Who has not said it by then does not say it.
constexpr auto patience = 1s;
constexpr std::size_t most_waiting_bytes = std::size_t{1} << 20U;

}  // namespace

void ProxyRecording::hear(bool to_scanner, sim::HostTime time, std::string_view bytes) {
    if (!trouble_.empty()) return;
    if (!first_) first_ = time;
    waiting_bytes_ += bytes.size();
    live_.hear(to_scanner, bytes, time);
    attempt([&] {
        if (begun_) return live_.write();
        if (time - *first_ >= patience || waiting_bytes_ > most_waiting_bytes) begin();
    });
}

void ProxyRecording::attempt(const std::function<void()>& write) {
    try {
        write();
    } catch (const std::exception& error) {
        trouble_ = error.what();
        std::cerr << "nothing more is recorded: " << trouble_ << '\n';
    }
}

void ProxyRecording::begin() {
    live_.write_to(sim::create_recording(file_, live_.identity(),
                                         {.name = "scipcat", .version = SCIPD_VERSION}));
    begun_ = true;
}

void ProxyRecording::finish() {
    if (trouble_.empty()) {
        attempt([&] {
            if (!begun_) begin();
            live_.finish();
        });
    }
    std::cerr << live_.scans() << (live_.scans() == 1 ? " scan" : " scans") << " recorded to "
              << file_ << '\n';
    if (!trouble_.empty()) throw std::runtime_error(trouble_);
}

}  // namespace scipd::tools
