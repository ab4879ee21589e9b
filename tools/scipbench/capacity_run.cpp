// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_run.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <nlohmann/json.hpp>

#include "daemon/models/model_registry.h"
#include "sim/world/pose.h"
#include "tools/control_client.h"
#include "tools/scipbench/bare_timer.h"
#include "tools/scipbench/capacity_daemon.h"
#include "tools/scipbench/capacity_site.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
using asio::ip::udp;

/// Models that move in the world of a measurement: boxes that go round in circles, whose poses a
/// thread of its own sends by UDP, as a simulator does. To be made and destroyed on one thread.
class CapacityMovers {
  public:
    /// Adds a model at each place, and sends poses to this port of 127.0.0.1 from then on.
    CapacityMovers(ControlClient& scipd, std::uint16_t port, const std::vector<sim::Pose>& places);
    CapacityMovers(const CapacityMovers&) = delete;
    CapacityMovers& operator=(const CapacityMovers&) = delete;

  private:
    std::jthread sender_;
};

using Clock = std::chrono::steady_clock;

constexpr const char* box =
    "<model name='mover'><link name='l'><visual name='v'><pose>0 0 0.4 0 0 0</pose><geometry><box>"
    "<size>0.2 0.15 0.8</size></box></geometry></visual></link></model>";

std::string name_of(std::size_t mover) {
    return "mover_" + std::to_string(mover);
}

std::string pose_line(std::size_t mover, const sim::Pose& pose) {
    const auto& [at, q] = pose;
    return nlohmann::json{
               {"model", name_of(mover)}, {"xyz", {at.x, at.y, at.z}}, {"q", {q.x, q.y, q.z, q.w}}}
               .dump() +
           "\n";
}

void send_all(udp::socket& socket, const std::vector<sim::Pose>& places, sim::Time time) {
    constexpr std::size_t most_bytes = 8000;
    std::string lines;
    const auto leave = [&] {
        boost::system::error_code lost;  // as UDP may lose them: the next ones come soon
        socket.send(asio::buffer(lines), 0, lost);
        lines.clear();
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        lines += pose_line(i, on_its_lap(places[i], time));
        if (lines.size() > most_bytes) leave();
    }
    if (!lines.empty()) leave();
}

void send_until(const std::stop_token& end, std::uint16_t port,
                const std::vector<sim::Pose>& places) {
    asio::io_context io;
    udp::socket socket(io, udp::v4());
    socket.connect({asio::ip::address_v4::loopback(), port});
    const Clock::time_point begin = Clock::now();
    for (sim::Time time{}; !end.stop_requested(); time += pose_period) {
        send_all(socket, places, time);
        std::this_thread::sleep_until(begin + time + pose_period);
    }
}

CapacityMovers::CapacityMovers(ControlClient& scipd, std::uint16_t port,
                               const std::vector<sim::Pose>& places) {
    for (std::size_t i = 0; i < places.size(); ++i)
        scipd.post("/scene/models", {{"name", name_of(i)}, {"sdf", box}});
    sender_ =
        std::jthread([port, places](const std::stop_token& end) { send_until(end, port, places); });
}

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// What scipd and the reader had used at one moment.
struct Look {
    Clock::time_point time;
    ProcessorUse scipd;
    ProcessorUse reader;
};

/// Looks at both until the reader has ended.
std::vector<Look> watch(pid_t scipd, ChildProgram& reader, Clock::duration patience) {
    constexpr auto between_looks = 100ms;
    std::vector<Look> looks;
    const Clock::time_point until = Clock::now() + patience;
    while (!reader.exit_code()) {
        if (Clock::now() > until) throw std::runtime_error("the reader does not end");
        const auto use_of_scipd = processor_use_of(scipd);
        const auto use_of_reader = processor_use_of(reader.pid());
        if (use_of_scipd && use_of_reader)
            looks.push_back({Clock::now(), *use_of_scipd, *use_of_reader});
        std::this_thread::sleep_for(between_looks);
    }
    return looks;
}

/// From the first look at the stream, which the reader ends with, to the last.
void tell_use(const std::vector<Look>& looks, Clock::time_point begin, CapacityRun& run) {
    const auto first = std::ranges::lower_bound(looks, begin, {}, &Look::time);
    if (first == looks.end() || &*first == &looks.back()) return;
    const Look& last = looks.back();
    const double seconds = Seconds(last.time - first->time).count();
    run.scipd_use = use_between(first->scipd, last.scipd, seconds);
    run.reader_use = use_between(first->reader, last.reader, seconds);
}

void read_findings(const ChildProgram& reader, CapacityRun& run) {
    const auto found = nlohmann::json::parse(reader.output(), nullptr, false);
    if (!found.is_object()) throw std::runtime_error("the reader fails: " + reader.errors());
    run.seconds = found.at("seconds");
    run.scans = found.at("scans");
    for (const char* fault : {"missing", "damaged", "disordered"})
        run.missing += found.at(fault).get<std::uint64_t>();
    run.reader = {found.at("delay_ms").at("p50"), found.at("delay_ms").at("p99")};
}

void read_status(const ControlClient::Json& status, CapacityRun& run) {
    std::vector<double> p50_ms;
    std::vector<double> p99_ms;
    for (const auto& sensor : status.at("sensors")) {
        run.lost += sensor.at("lost").get<std::uint64_t>();
        const auto& late = sensor.at("lateness_ms");
        if (late.at("p50").is_null()) continue;  // it has sent no scan
        p50_ms.push_back(late.at("p50"));
        p99_ms.push_back(late.at("p99"));
    }
    std::ranges::sort(p50_ms);
    std::ranges::sort(p99_ms);
    run.scipd = {at_share(p50_ms, 0.5), at_share(p99_ms, 0.5)};
    run.worst_p99_ms = at_share(p99_ms, 1.0);
}

/// The sum of all samples of a metric.
double sum_of(const std::string& metrics, const std::string& name) {
    double sum = 0.0;
    std::istringstream lines(metrics);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(name + "{")) sum += std::stod(line.substr(line.rfind(' ')));
    }
    return sum;
}

void read_metrics(const std::string& metrics, CapacityRun& run) {
    const double casts = sum_of(metrics, "scipd_casts_total");
    if (casts > 0) run.casts_us = 1e6 * sum_of(metrics, "scipd_cast_seconds_total") / casts;
}

void run_in_full(const CapacitySetup& setup, const std::vector<sim::Pose>& places,
                 CapacityRun& run) {
    // Each scanner answers within a few milliseconds before the first one streams.
    const auto patience = setup.duration + 60s + places.size() * 100ms;
    CapacityDaemon scipd(setup, {places.begin(), places.begin() + run.scanners});
    run.start_s = scipd.start().count();
    const CapacityMovers movers(scipd.control(), scipd.poses_port(),
                                {places.begin() + run.scanners, places.end()});
    const sim::Time period = daemon::find_model(setup.model).optics.scan_period;
    BareTimer timer(period);
    ChildProgram reader(load_command(scipd.targets(), setup.duration), scipd.folder(), "load");
    const std::vector<Look> looks = watch(scipd.pid(), reader, patience);
    const Clock::time_point begin = Clock::now() - setup.duration;
    const std::vector<double> timer_ms = timer.late_ms_since(begin);
    run.timer = {at_share(timer_ms, 0.5), at_share(timer_ms, 0.99)};
    run.whole = reader.exit_code() == 0;
    read_findings(reader, run);
    run.scans_due = run.scanners * (run.seconds / Seconds(period).count());
    tell_use(looks, begin, run);
    read_status(scipd.control().get("/status"), run);
    read_metrics(scipd.control().text("/metrics"), run);
}

}  // namespace

CapacityRun run_scanners(const CapacitySetup& setup, const std::vector<sim::Pose>& places) {
    CapacityRun run{.scanners = static_cast<int>(places.size()) - setup.moving};
    try {
        run_in_full(setup, places, run);
    } catch (const std::runtime_error& error) {
        run.failure = error.what();
        while (run.failure.ends_with('\n'))
            run.failure.pop_back();
    }
    return run;
}

}  // namespace scipd::tools
