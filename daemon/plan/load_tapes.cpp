// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_tapes.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <ranges>
#include <utility>
#include <vector>

#include "daemon/plan/read_tape.h"
#include "sim/loaders/file/load_error.h"
#include "sim/text/name.h"

namespace scipd::daemon {
namespace {

/// Says of itself what the recorded one said.
void take_identity(const sim::ScannerIdentity& identity, Model& model) {
    protocol::DeviceProfile& profile = model.profile;
    for (const auto& [key, target] :
         {std::pair{"VEND", &profile.vendor}, std::pair{"PROD", &profile.product},
          std::pair{"FIRM", &profile.firmware}, std::pair{"PROT", &profile.protocol}}) {
        if (auto said = value_of(identity.version, key); !said.empty()) *target = std::move(said);
    }
    if (identity.serial.empty()) return;
    profile.serial = identity.serial;
    model.own_serial = true;
}

/// A sensor that plays, and the scanner that it plays.
struct Player {
    std::string name;
    SensorConfig* sensor = nullptr;
    std::optional<sim::HostTime> first = std::nullopt;
    std::optional<sim::HostTime> logged = std::nullopt;
    std::shared_ptr<Tape> tape = nullptr;  ///< until it is part of the track
    Track track = {};
};

using Log = std::vector<Player>;

struct Silence {
    sim::Time from{};
    sim::Time to{};
};

/// Stretches of more than a minute in which no scanner of a log has a scan, but for their first
/// second.
std::vector<Silence> silences(const Log& log) {
    constexpr auto longest = std::chrono::minutes(1);
    constexpr auto kept = std::chrono::seconds(1);
    std::vector<sim::Time> begins;
    for (const Player& player : log)
        for (std::size_t i = 0; i < player.tape->size(); ++i)
            begins.push_back(player.track.lead + player.tape->begin(i));
    std::ranges::sort(begins);
    std::vector<Silence> silences;
    for (std::size_t i = 1; i < begins.size(); ++i)
        if (begins[i] - begins[i - 1] > longest)
            silences.push_back({begins[i - 1] + kept, begins[i]});
    return silences;
}

/// Distances in time by headers, or by the recorder where headers have several clocks.
void align(Log& log) {
    constexpr auto one_clock = std::chrono::hours(1);
    using TimeOf = std::optional<sim::HostTime> Player::*;
    const auto lead_by = [&](TimeOf time) {
        auto earliest = sim::HostTime::max();
        for (const Player& player : log)
            if (player.*time) earliest = std::min(earliest, *(player.*time));
        sim::Time longest{};
        for (Player& player : log) {
            player.track.lead = player.*time ? *(player.*time) - earliest : sim::Time::zero();
            longest = std::max(longest, player.track.lead);
        }
        return longest;
    };
    const bool all_logged =
        std::ranges::all_of(log, [](const Player& player) { return player.logged.has_value(); });
    if (lead_by(&Player::first) > one_clock && all_logged) lead_by(&Player::logged);
}

/// "front_scan" of /front/scan, of letters that the name of a sensor may have.
std::string sensor_of_topic(const std::string& topic) {
    std::string name;
    for (const char letter : topic) {
        const bool legal = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-';
        if (legal || (!name.empty() && name.back() != '_')) name += legal ? letter : '_';
    }
    while (name.ends_with('_'))
        name.pop_back();
    return name.empty() ? "scanner" : name.substr(0, sim::longest_name - 4);
}

/// The sensor of a robot becomes one for each scanner of its recording, on ports one after the
/// other.
void serve_all(RobotConfig& robot, const std::stop_token& stop) {
    const SensorConfig first = robot.sensors.front();
    robot.sensors.clear();
    for (const std::string& stream : recorded_streams(*first.replay, stop)) {
        SensorConfig sensor = first;
        const std::string name = sensor_of_topic(stream);
        const auto is_taken = [&](const SensorConfig& other) { return other.name == sensor.name; };
        sensor.name = name;
        for (int i = 2; std::ranges::any_of(robot.sensors, is_taken); ++i)
            sensor.name = name + "_" + std::to_string(i);
        sensor.replay->stream = stream;
        sensor.replay->serves_all = false;
        const std::size_t port = sensor.tcp ? sensor.tcp->port + robot.sensors.size() : 0;
        if (port > std::numeric_limits<std::uint16_t>::max())
            throw sim::LoadError({"--tcp " + text_of(*first.tcp) +
                                  " leaves no port for each scanner of the recording; take a "
                                  "lower one, or port 0"});
        if (sensor.tcp && sensor.tcp->port != 0)
            sensor.tcp->port = static_cast<std::uint16_t>(port);
        if (sensor.pty && !sensor.pty->link.empty()) sensor.pty->link += "-" + sensor.name;
        robot.sensors.push_back(std::move(sensor));
    }
}

/// Collects the errors of all sensors.
class Loader {
  public:
    explicit Loader(const std::stop_token& stop) : stop_(stop) {}

    void add(const std::string& name, SensorConfig& sensor, ClockKind clock) {
        guard(name, sensor, [&] {
            const ReplayConfig& replay = *sensor.replay;
            if (replay.begins_s && clock != ClockKind::poses)
                throw sim::LoadError({"begins_s is a stamp of poses, and needs clock: poses"});
            RecordedScanner scanner = recorded_scanner(replay);
            if (replay.finds_model) {
                take_identity(scanner.identity, scanner.model);
                sensor.model = std::move(scanner.model);
            }
            logs_[replay.files].push_back({.name = name,
                                           .sensor = &sensor,
                                           .first = scanner.first,
                                           .logged = scanner.logged});
        });
    }

    LoadedTapes load(bool strict) {
        for (auto& [files, log] : logs_)
            load(log);
        if (strict) std::ranges::copy(loaded_.warnings, std::back_inserter(errors_));
        if (!errors_.empty()) throw sim::LoadError(std::move(errors_));
        return std::move(loaded_);
    }

  private:
    template <class Step>
    void guard(const std::string& name, const SensorConfig& sensor, const Step& step) {
        try {
            step();
        } catch (const sim::LoadError& error) {
            const bool is_several = dynamic_cast<const SeveralScanners*>(&error) != nullptr;
            if (is_several && sensor.replay->serves_all) throw;
            std::ranges::transform(error.faults(), std::back_inserter(errors_),
                                   [&](const auto& why) { return name + ": " + why; });
        }
    }

    /// Sensors that play the same files share a time line.
    void load(Log& log) {
        align(log);
        std::optional<sim::Time> recorded;
        for (Player& player : log) {
            guard(player.name, *player.sensor, [&] {
                const sim::Time lead = player.track.lead;
                player.tape = read(player, lead);
                if (const auto first = player.tape->recorded())
                    recorded = std::min(recorded.value_or(*first - lead), *first - lead);
            });
        }
        if (!errors_.empty()) return;
        cut_silence(log);
        sim::Time duration{};
        for (const Player& player : log)
            duration =
                std::max(duration, player.track.lead + player.tape->begin(player.tape->size()));
        const auto line = std::make_shared<LogLine>(recorded, duration);
        for (Player& player : log) {
            player.track.tape = std::move(player.tape);
            player.track.line = line;
            loaded_.tracks[player.name] = std::move(player.track);
        }
    }

    /// Removes hours in which no scanner of the log was on, unless stamps of poses tell when each
    /// scan is due.
    void cut_silence(Log& log) {
        const ReplayConfig& replay = *log.front().sensor->replay;
        const auto stamped = [](const Player& player) {
            return player.sensor->replay->begins_s.has_value();
        };
        if (std::ranges::any_of(log, stamped)) return;
        sim::Time cut{};
        const std::vector<Silence> all = silences(log);
        for (const auto& [from, to] : std::views::reverse(all)) {
            cut += to - from;
            for (Player& player : log) {
                sim::Time& lead = player.track.lead;
                if (lead < to) player.tape->cut(from - lead, to - lead);
                if (player.sensor->replay->from >= to) player.track.cut += to - from;
                if (lead >= to) lead -= to - from;
            }
        }
        if (cut > sim::Time::zero())
            loaded_.warnings.push_back(
                replay.name() + ": has no scan for more than a minute, " +
                std::to_string(all.size()) + " times, in sum for " +
                std::to_string(std::chrono::round<std::chrono::seconds>(cut).count()) +
                " s, which are left out");
    }

    /// Its warnings are told once a recording.
    std::shared_ptr<Tape> read(const Player& player, sim::Time lead) {
        ReplayConfig replay = *player.sensor->replay;
        replay.from = std::max(replay.from - lead, sim::Time::zero());
        std::vector<std::string> warnings;
        auto tape = read_tape(replay, player.sensor->model, warnings, stop_);
        for (std::string& warning : warnings) {
            if (std::ranges::find(loaded_.warnings, warning) == loaded_.warnings.end())
                loaded_.warnings.push_back(std::move(warning));
        }
        return tape;
    }

    const std::stop_token& stop_;
    std::map<std::vector<std::filesystem::path>, Log> logs_;
    LoadedTapes loaded_;
    std::vector<std::string> errors_;
};

LoadedTapes load_as_configured(Config& config, const std::stop_token& stop) {
    Loader loader(stop);
    for (RobotConfig& robot : config.robots) {
        for (SensorConfig& sensor : robot.sensors) {
            if (sensor.replay)
                loader.add(sensor_name(robot.name, sensor.name), sensor, config.clock);
        }
    }
    return loader.load(config.strict);
}

}  // namespace

LoadedTapes load_tapes(Config& config, const std::stop_token& stop) {
    try {
        return load_as_configured(config, stop);
    } catch (const SeveralScanners&) {
        serve_all(config.robots.front(), stop);
        return load_as_configured(config, stop);
    }
}

}  // namespace scipd::daemon
