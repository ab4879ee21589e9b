// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_command.h"

#include <chrono>
#include <memory>

#include "sim/loaders/file/load_error.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipbench/measure_capacity.h"
#include "tools/scipbench/setup_options.h"

namespace scipd::tools {
namespace {

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

}  // namespace scipd::tools
