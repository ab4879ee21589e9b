// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/scipd_command.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace scipd::testing {
namespace {

/// A configuration that is an object becomes a file, as JSON is YAML as well.
std::string config_file(const Json& config, const std::filesystem::path& folder) {
    if (config.is_string()) return config.get<std::string>();
    std::string file = folder / "scipd.yaml";
    std::ofstream(file) << config.dump();
    return file;
}

}  // namespace

std::vector<std::string> command_for(const Options& options, const std::filesystem::path& program,
                                     const std::filesystem::path& folder) {
    std::vector<std::string> command{program};
    const auto given = [&](const std::string& option) {
        return std::ranges::any_of(options.args, [&](const std::string& argument) {
            return argument.substr(0, argument.find('=')) == option;
        });
    };
    const auto choose = [&](const std::string& option, const std::string& value) {
        if (!value.empty() && !given(option)) command.insert(command.end(), {option, value});
    };
    choose("--control", folder / "control.sock");
    choose("--http", "127.0.0.1:0");
    choose("--clock", options.clock == ClockKind::wall ? "wall" : "poses");
    choose("--scene", options.world);
    choose("--seed", options.seed ? std::to_string(*options.seed) : "");
    choose("--poses", options.poses);
    if (options.config.is_null()) {
        choose("--model", options.model);
        choose("--tcp", "127.0.0.1:0");
        choose("--pty", "auto");
        choose("--accuracy", options.accuracy);
        // A scanner in the plane of the floor sees what stands on it or not, by chance. In the maze
        // scipd mounts it so as well.
        if (!options.world.empty() && !given("--sensor-from")) choose("--mount", "0,0,0.25,0,0,0");
    } else {
        if (!options.accuracy.empty())
            throw std::invalid_argument(
                "accuracy is of one scanner: where there is a config, it "
                "stands there");
        choose("--config", config_file(options.config, folder));
    }
    command.insert(command.end(), options.args.begin(), options.args.end());
    return command;
}

}  // namespace scipd::testing
