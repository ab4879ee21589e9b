// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/twin_daemon.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>

#include <nlohmann/json.hpp>

#include "tools/child_program.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Beside this program, in a build as in an installation.
fs::path scipd_beside() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path() / "scipd";
}

fs::path new_folder() {
    std::string pattern = fs::temp_directory_path() / "scipcat-twin-XXXXXX";
    if (::mkdtemp(pattern.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), pattern);
    return pattern;
}

std::string without_end(std::string text) {
    while (text.ends_with('\n'))
        text.pop_back();
    return text;
}

}  // namespace

TwinDaemon::TwinDaemon(const fs::path& configuration) : folder_(new_folder()) {
    const std::vector<std::string> command{
        scipd_beside(), "--config", configuration, "--free-ports",
        "--http",       "none",     "--control",   folder_ / "control.sock",
        "--log-level",  "error"};
    scipd_ = std::make_unique<ChildProgram>(command, folder_, "scipd");
    try {
        wait_until_ready(configuration);
    } catch (...) {
        scipd_.reset();
        fs::remove_all(folder_);
        throw;
    }
}

TwinDaemon::~TwinDaemon() {
    scipd_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

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
