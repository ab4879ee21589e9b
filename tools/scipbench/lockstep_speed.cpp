// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/lockstep_speed.h"

#include <algorithm>
#include <future>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>

#include <boost/asio/io_context.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "tools/scipbench/capacity_daemon.h"
#include "tools/scipbench/capacity_world.h"
#include "tools/scipbench/spread.h"
#include "tools/scipbench/stream_reader.h"

namespace scipd::tools {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Readers = std::vector<std::unique_ptr<StreamReader>>;

Readers connect(boost::asio::io_context& io, const std::vector<std::string>& targets) {
    Readers readers;
    for (const std::string& target : targets)
        readers.push_back(std::make_unique<StreamReader>(io, target));
    return readers;
}

void check(const StreamReader& reader) {
    const bool sound = reader.check().findings().sound() && reader.ended().empty();
    if (!sound) throw std::runtime_error("the stream of " + reader.target() + " is not whole");
}

/// How long the readers take to get so many seconds of the world.
Seconds read_all(boost::asio::io_context& io, Readers& readers, Seconds of_world) {
    std::size_t lacking = readers.size();
    const Clock::time_point begin = Clock::now();
    for (const auto& reader : readers) {
        const auto scans = static_cast<std::uint64_t>(of_world / reader->period());
        reader->start([&io, &lacking, there = reader.get(), scans, done = false]() mutable {
            if (done) return;
            done = !there->ended().empty() || there->check().findings().scans >= scans;
            if (done && --lacking == 0) io.stop();
        });
    }
    constexpr int longer = 6;  // nobody asks here when a scan came
    read_streams(io, longer * rest_for(readers.size()));
    return Clock::now() - begin;
}

/// Reads only where scipd leaves a processor free, as if the hosts had machines of their own. To
/// check each byte of 50 scanners takes 8 % of a core, which one of scipd's threads would lack.
Seconds read_behind(boost::asio::io_context& io, Readers& readers, Seconds of_world) {
    const auto read = [&] {
        constexpr int last_of_all = 19;
        ::setpriority(PRIO_PROCESS, 0, last_of_all);  // on Linux, of this thread
        return read_all(io, readers, of_world);
    };
    return std::async(std::launch::async, read).get();
}

double times_real(const CapacitySetup& setup, const std::vector<sim::Pose>& places) {
    CapacityDaemon scipd(setup, places);
    boost::asio::io_context io;
    Readers readers = connect(io, scipd.targets());
    const Seconds spent = read_behind(io, readers, setup.duration);
    for (const auto& reader : readers)
        check(*reader);
    return Seconds(setup.duration) / spent;
}

std::string counted(int count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace

std::vector<LockstepSpeed> measure_lockstep(const LockstepQuestion& question) {
    CapacitySetup setup = question.setup;
    const auto places = CapacityWorld(setup.scene).places(question.scanners);
    std::vector<LockstepSpeed> speeds;
    for (const int threads : question.threads)
        speeds.push_back({threads, {}});
    for (int round = 0; round < question.rounds; ++round) {
        for (LockstepSpeed& speed : speeds) {
            setup.threads = speed.threads;
            speed.times_real.push_back(times_real(setup, places));
        }
    }
    return speeds;
}

void print_lockstep(const LockstepQuestion& question, const std::vector<LockstepSpeed>& speeds,
                    std::ostream& out) {
    const CapacitySetup& setup = question.setup;
    out << setup.scene.string() << ", " << counted(question.scanners, "driving scanner") << " ("
        << setup.model << "), " << setup.duration.count() << " s of the world a run, "
        << counted(question.rounds, "round") << "\n\n";
    const double first = spread_of(speeds.front().times_real).median;
    for (const LockstepSpeed& speed : speeds) {
        const Spread spread = spread_of(speed.times_real);
        out << counted(speed.threads, "thread") << ": " << significant(spread.median, 3)
            << " times real time (" << significant(spread.low, 3) << " to "
            << significant(spread.high, 3) << ")";
        if (&speed != &speeds.front()) {
            out << ", " << significant(spread.median / first, 3) << " times as fast as "
                << counted(speeds.front().threads, "thread");
        }
        out << "\n";
    }
}

void write_lockstep_json(const LockstepQuestion& question, const std::vector<LockstepSpeed>& speeds,
                         std::ostream& out) {
    nlohmann::ordered_json runs = nlohmann::json::array();
    for (const LockstepSpeed& speed : speeds) {
        runs.push_back({{"threads", speed.threads},
                        {"times_real_time", spread_of(speed.times_real).median},
                        {"rounds", speed.times_real}});
    }
    const CapacitySetup& setup = question.setup;
    const nlohmann::ordered_json document{{"scene", setup.scene.string()},
                                          {"model", setup.model},
                                          {"scanners", question.scanners},
                                          {"seconds", setup.duration.count()},
                                          {"runs", runs}};
    out << document.dump(2) << "\n";
}

}  // namespace scipd::tools
