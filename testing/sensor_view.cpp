// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/sensor_view.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <numbers>
#include <system_error>
#include <utility>

#include "protocol/client/driver.h"
#include "testing/listener.h"

namespace scipd::testing {
namespace {

namespace client = protocol::client;
using namespace std::chrono_literals;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Step of time in lockstep while a client waits for a truth; less than a revolution of any scanner.
constexpr TestClock::Seconds part_of_a_turn = 20ms;
// Shortest step between two sweeps, for scanners that measure nearly all around.
constexpr TestClock::Seconds shortest_step = 500us;
// A scanner whose TCP port somebody else uses lets a second client wait.
constexpr auto free_patience = 1s;
// Those of a second, of the fastest scanner.
constexpr int most_turns_kept = 100;

/// Requests the next turn, with intensities unless the model has none.
void request_turn(client::Driver& driver, const client::Parameters& parameters) {
    client::ScanRequest request{.first_step = parameters.amin, .last_step = parameters.amax};
    request.intensity = true;
    request.scans = 1;
    try {
        driver.start(request);
    } catch (const client::Error& error) {
        if (error.kind() != client::Error::Kind::refused) throw;
        request.intensity = false;
        driver.start(request);
    }
}

Scan scan_of(const std::string& sensor, const client::Parameters& parameters,
             const client::ScanMessage& message) {
    Scan scan{.sensor = sensor};
    scan.intensities = message.intensities;
    scan.sent_mm = message.distances_mm;
    scan.stamp_ms = message.stamp_ms;
    for (std::size_t i = 0; i < scan.sent_mm.size(); ++i) {
        const std::uint32_t mm = scan.sent_mm[i];
        scan.ranges_m.push_back(parameters.is_distance(mm) ? std::optional(mm / 1000.0)
                                                           : std::nullopt);
        scan.angles_rad.push_back(
            parameters.angle_rad(message.request.first_step + static_cast<double>(i)));
    }
    return scan;
}

/// The messages of /stream about one sensor.
class Turns {
  public:
    Turns(const std::string& control, const std::string& sensor)
        : listener_(control, "/stream?sensor=" + tools::path_segment(sensor),
                    [this](const std::string& text) { hear(text); }) {}

    /// The latest turn that begins after this; null if there is none yet.
    [[nodiscard]] Json after(double begin_s, milliseconds patience) {
        std::unique_lock lock(mutex_);
        const auto is_there = [&] { return latest_.value("time_s", -1.0) >= begin_s; };
        return news_.wait_for(lock, patience, is_there) ? latest_ : Json();
    }

  private:
    void hear(const std::string& text) {
        Json message = Json::parse(text);
        if (!message.contains("scan")) return;  // a fault
        const std::lock_guard lock(mutex_);
        latest_ = std::move(message);
        news_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable news_;
    Json latest_ = Json::object();
    Listener listener_;  ///< last, as its thread uses the others
};

template <class Value>
std::vector<Value> list_of(const Json& values, const Value& in_place_of_null) {
    std::vector<Value> list;
    for (const Json& value : values)
        list.push_back(value.is_null() ? in_place_of_null : Value(value.get<Value>()));
    return list;
}

}  // namespace

SensorView::SensorView(Running& running, TestClock& clock, const std::string& name)
    : running_(running),
      clock_(clock),
      told_(running.sensor(name)),
      name_(told_.at("name")),
      path_(sensor_path(name_)) {
    if (!clock.leads()) return;
    meanwhile_ = [this] {
        const TestClock::Seconds sweep = std::exchange(sweep_, {});
        clock_.run(sweep.count() > 0 ? sweep : step_);
    };
}

Scan SensorView::next_scan(milliseconds timeout) try {
    ScannerLine line = open_line();
    line.give_up_at(steady_clock::now() + timeout);
    client::Driver driver(line, {.reply = timeout, .scan = timeout});
    keep_scans();
    driver.connect();
    const client::Parameters parameters = driver.parameters();
    front_step_ = parameters.afrt;
    steps_per_turn_ = parameters.ares;
    request_turn(driver, parameters);
    const TestClock::Seconds turn = 1min / static_cast<double>(parameters.scan_rpm);
    sweep_ = turn * parameters.amax / parameters.ares;
    step_ = std::max(shortest_step, (turn - sweep_) / 2);
    return scan_of(name_, parameters, driver.next_scan());
} catch (const client::Error& error) {
    throw explained(error.what());
} catch (const std::system_error& error) {
    throw explained(error.what());
}

/// Whoever asks for a truth has scipd keep that of the last second, for a minute.
void SensorView::keep_scans() try {
    (void)running_.get(path_ + "/truth");
} catch (const Refused& refused) {
    if (refused.status() != 404) throw;  // nothing has been measured yet
}

/// By TCP where that is free, else by the tty.
ScannerLine SensorView::open_line() {
    const Json& tcp = told_.at("tcp");
    const Json& tty = told_.at("pty");
    if (tcp.is_null() && tty.is_null())
        throw NoScan(name_ + " is no scanner that can be reached: it has neither TCP nor a tty");
    if (!tcp.is_null()) {
        const bool nobody = running_.get(path_).at("clients") == 0;
        ScannerLine line = ScannerLine::tcp(tcp, meanwhile_);
        if (nobody || is_free(line)) return line;
    }
    if (tty.is_null())
        throw NoScan(name_ +
                     " serves one TCP client at a time, and another one is connected: give "
                     "it a tty (pty: auto), or ask for truth()");
    return ScannerLine::tty(tty, meanwhile_);
}

bool SensorView::is_free(ScannerLine& line) {
    line.write("VV\n");
    char first = 0;
    return line.read(std::span(&first, 1), free_patience) == 1;
}

NoScan SensorView::explained(const std::string& why) {
    std::string wrong;
    for (const Json& fault : running_.get(path_ + "/faults")) {
        if (fault.at("state") != "active") continue;
        wrong +=
            (wrong.empty() ? "; on purpose it has: " : ", ") + fault.at("kind").get<std::string>();
    }
    const std::string state = running_.get(path_).at("state");
    return NoScan(name_ + " has sent no scan: " + why + ". Its state is '" + state + "'" + wrong);
}

Truth SensorView::next_truth(milliseconds timeout) {
    const double begin_s = clock_.now_s();
    const auto end = steady_clock::now() + timeout;
    Turns turns(running_.control(), name_);
    for (;;) {
        const Json turn = turns.after(begin_s, clock_.leads() ? 10ms : timeout);
        if (!turn.is_null()) {
            front_step_ = turn.value("front_step", 0);
            steps_per_turn_ = turn.value("steps_per_turn", 0);
            return truth_in(running_.get(path_ + "/truth"));
        }
        if (steady_clock::now() >= end) {
            const std::string state = running_.get(path_).at("state");
            throw NoScan(name_ + " has measured nothing in time; its state is '" + state + "'");
        }
        clock_.run(part_of_a_turn);
    }
}

Truth SensorView::truth_of(const Scan& scan) {
    Json raw = running_.get(path_ + "/truth");
    // There is none of turns that nobody wanted.
    const int latest = raw.at("scan");
    for (int number = latest - 1; raw.at("stamp_ms") != scan.stamp_ms; --number) {
        if (number < 0 || number < latest - most_turns_kept)
            throw ScipdError("scipd keeps no truth of the scan with the stamp " +
                             std::to_string(scan.stamp_ms) + " ms: ask within a second");
        try {
            raw = running_.get(path_ + "/truth?scan=" + std::to_string(number));
        } catch (const Refused&) {
            continue;
        }
    }
    Truth truth = truth_in(std::move(raw));
    truth.angles_rad = scan.angles_rad;
    return truth;
}

Truth SensorView::truth_in(Json raw) const {
    Truth truth{.sensor = name_, .time_s = raw.at("time_s")};
    for (const Json& range : raw.at("true_m"))
        truth.ranges_m.push_back(range.is_null() ? std::nullopt : std::optional<double>(range));
    truth.objects = list_of<std::string>(raw.at("object"), "");
    truth.materials = list_of<std::string>(raw.at("material"), "");
    if (raw.contains("steps") && steps_per_turn_ > 0) {
        const double step_rad = 2.0 * std::numbers::pi / steps_per_turn_;
        for (const Json& step : raw.at("steps"))
            truth.angles_rad.push_back((step.get<int>() - front_step_) * step_rad);
    }
    truth.raw = std::move(raw);
    return truth;
}

}  // namespace scipd::testing
