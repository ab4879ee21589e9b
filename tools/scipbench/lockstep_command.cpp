// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/lockstep_command.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "sim/loaders/file/load_error.h"
#include "tools/options.h"
#include "tools/scipbench/lockstep_speed.h"
#include "tools/scipbench/machine.h"
#include "tools/scipbench/setup_options.h"

namespace scipd::tools {
namespace {

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
