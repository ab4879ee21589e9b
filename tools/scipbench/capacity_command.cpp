// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include <unistd.h>

#include "daemon/config/demo_world.h"
#include "daemon/models/model_registry.h"
#include "sim/loaders/file/load_error.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipbench/lockstep_speed.h"
#include "tools/scipbench/machine.h"
#include "tools/scipbench/measure_capacity.h"

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

/// --model, --scene and --scipd.
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

/// The rescue maze, and the scipd beside this program, where nobody has said another. Throws
/// WrongInput where one of them is not there.
void fill_in(CapacitySetup& setup) {
    if (setup.scipd.empty()) setup.scipd = scipd_beside();
    if (::access(setup.scipd.c_str(), X_OK) != 0)
        throw WrongInput(setup.scipd.string() + " is no program; name scipd with --scipd");
    if (setup.scene.empty()) setup.scene = maze();
}

struct Asked {
    CapacityQuestion question;
    int seconds = 10;
    bool start = false;
};

void answer(Asked& asked) {
    CapacitySetup& setup = asked.question.setup;
    fill_in(setup);
    setup.duration = std::chrono::seconds(asked.seconds);
    try {
        asked.start ? measure_start(asked.question) : measure_capacity(asked.question);
    } catch (const sim::LoadError& error) {
        throw WrongInput(error.what());
    }
}

void add_setup(CLI::App& capacity, CapacitySetup& setup) {
    add_world_and_scanner(capacity, setup);
    capacity.add_flag("--driving", setup.driving,
                      "every robot drives in a circle, by 50 poses a second from a file");
    capacity
        .add_option("--moving", setup.moving, "N boxes move among them, by 50 poses a second each")
        ->check(whole_within(0, 10'000))
        ->option_text("N [0]");
    capacity.add_option("--threads", setup.threads, "number of threads that run the scanners")
        ->check(whole_within(1, 1024))
        ->option_text("N [scipd's own choice]");
}

struct LockstepSaid {
    LockstepQuestion question;
    int seconds = 10;
    bool json = false;
};

void answer(LockstepSaid& said) {
    LockstepQuestion& question = said.question;
    fill_in(question.setup);
    question.setup.lockstep = true;
    question.setup.driving = true;
    question.setup.duration = std::chrono::seconds(said.seconds);
    try {
        const auto speeds = measure_lockstep(question);
        if (said.json) return write_lockstep_json(question, speeds, std::cout);
        std::cout << describe_machine() << "\n";
        print_lockstep(question, speeds, std::cout);
    } catch (const sim::LoadError& error) {
        throw WrongInput(error.what());
    }
}

int processors() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

void add_capacity(CLI::App& program) {
    constexpr int most_scanners = 20'000;
    const auto asked = std::make_shared<Asked>();
    CapacityQuestion& question = asked->question;
    CLI::App* capacity =
        program.add_subcommand("capacity",
                               "find out how many scanners one scipd can emulate on this machine "
                               "without losing a scan, what they cost and what limits");
    capacity->alias("fleet");  // as it was called in 0.1
    add_setup(*capacity, question.setup);
    capacity->add_option("-s,--seconds", asked->seconds, "duration of each run")
        ->check(whole_within(1, 1'000'000))
        ->capture_default_str();
    auto* const scanners =
        capacity
            ->add_option("-n,--scanners", question.scanners, "run N scanners instead of searching")
            ->check(whole_within(1, most_scanners))
            ->option_text("N");
    auto* const most = capacity->add_option("--most", question.most, "upper limit of the search")
                           ->check(whole_within(1, most_scanners))
                           ->excludes(scanners)
                           ->option_text("N");
    auto* const csv =
        capacity->add_option("--csv", question.csv, "table to write, one line per run")
            ->check(can_be_written)
            ->option_text("FILE.csv");
    auto* const plot =
        capacity->add_option("-o,--plot", question.plot, "picture to draw: the share of all cores")
            ->check(is_picture)
            ->check(can_be_written)
            ->option_text("FILE.png|FILE.svg");
    capacity
        ->add_flag("--start", asked->start,
                   "measure the start instead: the time until 500 scanners, or --scanners, are "
                   "ready, and until scipd answers GET /status")
        ->excludes(csv)
        ->excludes(plot)
        ->excludes(most)
        ->excludes("--moving");
    capacity->callback([asked] { answer(*asked); });
}

void add_lockstep(CLI::App& program) {
    const auto said = std::make_shared<LockstepSaid>();
    LockstepQuestion& question = said->question;
    question.threads = {1};
    if (processors() > 1) question.threads.push_back(processors());
    CLI::App* command =
        program.add_subcommand("lockstep",
                               "measure the real-time factor of scipd in lockstep (clock: poses), "
                               "with one thread and with one per processor");
    add_world_and_scanner(*command, question.setup);
    command
        ->add_option("-n,--scanners", question.scanners,
                     "number of scanners, each on a robot that drives")
        ->check(whole_within(1, 20'000))
        ->capture_default_str();
    command->add_option("-s,--seconds", said->seconds, "duration of each run in the world's time")
        ->check(whole_within(1, 1'000'000))
        ->capture_default_str();
    command->add_option("--threads", question.threads, "numbers of threads to compare")
        ->delimiter(',')
        ->check(whole_within(1, 1024))
        ->option_text("N,... [1 and all]");
    command->add_option("--rounds", question.rounds, "number of measurements of each, in turn")
        ->check(whole_within(1, 1000))
        ->capture_default_str();
    command->add_flag("--json", said->json, "as a JSON document");
    command->callback([said] { answer(*said); });
}

}  // namespace scipd::tools
