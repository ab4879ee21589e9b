// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_daemon.h"

#include <stdexcept>
#include <thread>

#include <nlohmann/json.hpp>

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::vector<std::string> command(const CapacitySetup& setup, const CapacitySite& site) {
    std::vector<std::string> words{setup.scipd, "--config", site.configuration(), "--log-level",
                                   "warning"};
    if (setup.threads) words.insert(words.end(), {"--threads", std::to_string(*setup.threads)});
    return words;
}

}  // namespace

CapacityDaemon::CapacityDaemon(const CapacitySetup& setup, const std::vector<sim::Pose>& places)
    : program_(
          [&] {
              site_.write(setup, places);
              begin_ = Clock::now();
              return command(setup, site_);
          }(),
          site_.folder(), "scipd"),
      control_(site_.control()) {
    wait_until_ready();
}

void CapacityDaemon::wait_until_ready() {
    constexpr auto patience = 120s;
    constexpr auto between_looks = 1ms;
    std::string line;
    while (!line.ends_with('\n')) {
        if (program_.exit_code())
            throw std::runtime_error("scipd does not start: " + program_.errors());
        if (Clock::now() - begin_ > patience) throw std::runtime_error("scipd does not get ready");
        std::this_thread::sleep_for(between_looks);
        line = program_.output();
        start_ = Clock::now() - begin_;
    }
    const auto ready = nlohmann::json::parse(line);
    for (const auto& sensor : ready.at("sensors")) {
        const auto& address = sensor.at("tcp");
        if (address.is_string()) targets_.push_back("tcp://" + address.get<std::string>());
    }
}

std::vector<std::string> load_command(const std::vector<std::string>& targets,
                                      std::chrono::seconds duration) {
    std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe"), "load",
                                   "--json", "--seconds", std::to_string(duration.count())};
    words.insert(words.end(), targets.begin(), targets.end());
    return words;
}

}  // namespace scipd::tools
