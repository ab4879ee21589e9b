// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tools/scipbench/capacity_daemon.h"
#include "tools/scipbench/capacity_world.h"
#include "tools/scipbench/machine.h"
#include "tools/scipbench/measure_capacity.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

struct Answers {
    std::vector<double> ms;
    std::size_t bytes = 0;
};

/// Asks for /status time and again, until `over`.
Answers ask(ControlClient& control, const auto& over) {
    constexpr auto between = 50ms;
    Answers answers;
    while (!over()) {
        answers.ms.push_back(
            milliseconds_for([&] { answers.bytes = control.text("/status").size(); }));
        std::this_thread::sleep_for(between);
    }
    std::ranges::sort(answers.ms);
    return answers;
}

void print(const char* when, const Answers& answers) {
    std::cout << "GET /status " << when << ": p50 " << significant(at_share(answers.ms, 0.5), 3)
              << " ms, p99 " << significant(at_share(answers.ms, 0.99), 3) << " ms, max "
              << significant(at_share(answers.ms, 1.0), 3) << " ms (" << answers.ms.size()
              << " answers of " << answers.bytes / 1000 << " kB)\n";
}

}  // namespace

void measure_start(const CapacityQuestion& question) {
    constexpr int usual_scanners = 500;
    const CapacitySetup& setup = question.setup;
    CapacityWorld world(setup.scene);
    const int scanners = question.scanners.value_or(std::min(usual_scanners, world.most()));
    CapacityDaemon scipd(setup, world.places(scanners));
    const auto begin = std::chrono::steady_clock::now();
    const Answers at_once =
        ask(scipd.control(), [&] { return std::chrono::steady_clock::now() - begin > 2s; });
    ChildProgram reader(load_command(scipd.targets(), setup.duration), scipd.folder(), "load");
    const Answers streaming = ask(scipd.control(), [&] { return reader.exit_code().has_value(); });
    std::cout << describe_machine() << "\n"
              << describe(setup) << "\n\n"
              << scanners << " scanners are ready " << significant(scipd.start().count(), 3)
              << " s after scipd was started\n";
    print("in the first two seconds", at_once);
    print("while they connect and stream", streaming);
}

}  // namespace scipd::tools
