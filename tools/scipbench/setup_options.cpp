// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/setup_options.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

#include "daemon/config/demo_world.h"
#include "daemon/models/model_registry.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;

/// Beside this program, in a build as in an installation.
fs::path scipd_beside() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path() / "scipd";
}

fs::path maze() {
    const auto scene = daemon::demo_scene();
    if (!scene) throw WrongInput(scene.error().why);
    return *scene;
}

}  // namespace

void add_world_and_scanner(CLI::App& command, CapacitySetup& setup) {
    command.add_option("--model", setup.model, "a scanner of `scipd --list-models`")
        ->check([](const std::string& name) {
            const auto model = daemon::model_named(name);
            return model ? std::string() : model.error().why;
        })
        ->option_text("MODEL [UST-10LX]");
    command.add_option("--scene", setup.scene, "world to measure in")
        ->check(CLI::ExistingFile)
        ->option_text("FILE [the rescue maze]");
    command.add_option("--scipd", setup.scipd, "program to measure")
        ->option_text("PROGRAM [the one beside scipbench]");
}

void fill_in(CapacitySetup& setup) {
    if (setup.scipd.empty()) setup.scipd = scipd_beside();
    if (::access(setup.scipd.c_str(), X_OK) != 0)
        throw WrongInput(setup.scipd.string() + " is no program; name scipd with --scipd");
    if (setup.scene.empty()) setup.scene = maze();
}

}  // namespace scipd::tools
