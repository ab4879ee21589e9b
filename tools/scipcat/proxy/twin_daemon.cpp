// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/twin_daemon.h"

#include <chrono>
#include <thread>

#include <nlohmann/json.hpp>

#include "tools/child_program.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string without_end(std::string text) {
    while (text.ends_with('\n'))
        text.pop_back();
    return text;
}

}  // namespace

TwinDaemon::TwinDaemon(const fs::path& configuration) : folder_("scipcat-twin") {
    const std::vector<std::string> command{program_beside("scipd"),
                                           "--config",
                                           configuration,
                                           "--free-ports",
                                           "--http",
                                           "none",
                                           "--control",
                                           folder_.path() / "control.sock",
                                           "--log-level",
                                           "error"};
    scipd_ = std::make_unique<ChildProgram>(command, folder_.path(), "scipd");
    wait_until_ready(configuration);
}

TwinDaemon::~TwinDaemon() = default;

void TwinDaemon::wait_until_ready(const fs::path& configuration) {
    constexpr auto patience = 120s;
    constexpr auto between_looks = 5ms;
    const auto until = std::chrono::steady_clock::now() + patience;
    std::string line;
    while (!line.ends_with('\n')) {
        if (scipd_->exit_code()) {
            throw WrongInput("--twin " + configuration.string() +
                             ": scipd does not start: " + without_end(scipd_->errors()));
        }
        if (std::chrono::steady_clock::now() > until)
            throw std::runtime_error("the twin's scipd does not get ready");
        std::this_thread::sleep_for(between_looks);
        line = scipd_->output();
    }
    const auto ready = nlohmann::json::parse(line);
    std::vector<std::string> places;
    for (const auto& sensor : ready.at("sensors")) {
        if (sensor.contains("tcp") && sensor["tcp"].is_string())
            places.push_back("tcp://" + sensor["tcp"].get<std::string>());
    }
    if (places.size() != 1) {
        throw WrongInput("--twin " + configuration.string() + " has " +
                         std::to_string(places.size()) +
                         " scanners; a twin is one: start scipd yourself and name the scanner as "
                         "tcp://HOST:PORT");
    }
    target_ = parse_target(places.front());
}

}  // namespace scipd::tools
