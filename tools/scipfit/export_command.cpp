// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "daemon/config/config_file.h"
#include "tools/options.h"
#include "tools/scipfit/export.h"
#include "tools/scipfit/scipfit_commands.h"

namespace scipd::tools {
namespace {

using Write = void (*)(const sim::SensorSpec&, std::ostream&);

struct ExportOptions {
    std::filesystem::path profile;
    std::string program;
};

const std::map<std::string, Write>& programs() {
    static const std::map<std::string, Write> programs{
        {"amcl", write_amcl}, {"gz", write_gz}, {"mvsim", write_mvsim}, {"stage", write_stage}};
    return programs;
}

/// The first scanner of a configuration.
sim::SensorSpec optics_in(const std::filesystem::path& file) {
    daemon::Config config;
    try {
        config = daemon::load_config(file);
    } catch (const std::exception& error) {
        throw WrongInput(error.what());
    }
    for (const daemon::RobotConfig& robot : config.robots) {
        for (const daemon::SensorConfig& sensor : robot.sensors) {
            if (!sensor.staring) return sensor.model.optics;
        }
    }
    throw WrongInput(file.string() + ": has no scanner; name what scipfit -o wrote");
}

}  // namespace

void add_export_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("export", "export the noise model for AMCL, gz, MVSim or Stage");
    const auto options = std::make_shared<ExportOptions>();
    command->add_option("PROFILE", options->profile, "profile written by scipfit -o")
        ->required()
        ->type_name("FILE.yaml");
    std::vector<std::string> names;
    for (const auto& [name, write] : programs())
        names.push_back(name);
    command->add_option("--for", options->program, "program to export for")
        ->required()
        ->check(CLI::IsMember(names));
    command->callback(
        [options] { programs().at(options->program)(optics_in(options->profile), std::cout); });
    command->footer(
        "Example:\n"
        "  scipfit export profile.yaml --for amcl");
}

}  // namespace scipd::tools
