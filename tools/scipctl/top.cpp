// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A table of the sensors that is drawn anew each second, as `top` has one of processes.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "tools/control_client.h"
#include "tools/safe_output.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

/// While it lives, keys are not echoed, and SIGINT (Ctrl-C), SIGTERM and SIGHUP do not end the
/// program. Its destructor restores the terminal.
class Keyboard {
  public:
    Keyboard();
    Keyboard(const Keyboard&) = delete;
    Keyboard& operator=(const Keyboard&) = delete;
    ~Keyboard();

    /// Waits so long. True, and at once: q was pressed, or one of the signals came. Where standard
    /// input is no terminal nobody presses anything.
    [[nodiscard]] bool ends_within(std::chrono::milliseconds time);

  private:
    struct Settings;
    std::unique_ptr<Settings> before_;  ///< of the terminal; null: there is none
};

using Clock = std::chrono::steady_clock;

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t signalled = 0;

void note(int /*signal*/) {
    signalled = 1;
}

bool in_foreground() {
    return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
}

struct Keyboard::Settings {
    termios values;
};

Keyboard::Keyboard() {
    // Without SA_RESTART, so that a signal ends a wait.
    struct sigaction action = {};
    action.sa_handler = note;
    for (const int signal : signals)
        ::sigaction(signal, &action, nullptr);
    termios settings{};
    // A program in the background would be stopped.
    if (!in_foreground() || ::tcgetattr(STDIN_FILENO, &settings) != 0) return;
    before_ = std::make_unique<Settings>(Settings{settings});
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

Keyboard::~Keyboard() {
    if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_->values);
    for (const int signal : signals)
        std::signal(signal, SIG_DFL);
}

bool Keyboard::ends_within(std::chrono::milliseconds time) {
    pollfd keys{before_ ? STDIN_FILENO : -1, POLLIN, 0};
    const Clock::time_point end = Clock::now() + time;
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
        const int ready = ::poll(&keys, 1, static_cast<int>(std::max<long>(left.count(), 0)));
        if (signalled != 0) return true;
        if (ready == 0) return false;
        char key = 0;
        if (ready > 0 && (::read(STDIN_FILENO, &key, 1) != 1 || key == 'q')) return true;
    }
}

/// True if standard output is a terminal.
bool draws_on_terminal() {
    return ::isatty(STDOUT_FILENO) == 1;
}

/// Rates between two statuses of a scipd.
struct SensorRates {
    std::string name;
    std::string model;
    std::string state;
    std::optional<double> scans_per_s;  ///< nothing: the sensor is new
    std::uint64_t lost = 0;             ///< scans, in all its life
    std::optional<double> lateness_p99_ms;
    std::uint64_t clients = 0;
    std::map<std::string, double> casts_per_s;  ///< by backend; without those that cast nothing
};

using Json = ControlClient::Json;

/// A count that has gone back is that of another sensor of the same name.
std::optional<double> rate(const Json& before, const Json& now, double seconds) {
    if (!before.is_number() || !now.is_number() || seconds <= 0) return std::nullopt;
    const double more = now.get<double>() - before.get<double>();
    return more < 0 ? std::nullopt : std::optional(more / seconds);
}

/// Returns null where there is none.
Json member(const Json& object, const std::string& key) {
    return object.is_object() ? object.value(key, Json()) : Json();
}

Json sensor_of(const Json& status, const Json& name) {
    const Json sensors = status.value("sensors", Json::array());
    const auto found = std::ranges::find_if(
        sensors, [&](const Json& sensor) { return member(sensor, "name") == name; });
    return found == sensors.end() ? Json() : *found;
}

std::map<std::string, double> cast_rates(const Json& before, const Json& now, double seconds) {
    std::map<std::string, double> rates;
    const Json casts_now = member(now, "casts");
    for (const auto& [backend, count] : casts_now.items()) {
        // A backend that has just taken over had cast nothing.
        const Json earlier = member(member(before, "casts"), backend);
        const auto casts =
            rate(before.is_null() || !earlier.is_null() ? earlier : Json(0), count, seconds);
        if (casts && *casts > 0) rates[backend] = *casts;
    }
    return rates;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

/// The rates of the sensors that the later status has. Both are answers to GET /status.
std::vector<SensorRates> rates_between(const Json& earlier, const Json& later) {
    const double seconds = later.value("uptime_s", 0.0) - earlier.value("uptime_s", 0.0);
    std::vector<SensorRates> rates;
    for (const Json& now : later.value("sensors", Json::array())) {
        const Json before = sensor_of(earlier, member(now, "name"));
        SensorRates sensor{
            .name = now.value("name", ""),
            .model = now.value("model", ""),
            .state = now.value("state", ""),
            .scans_per_s = rate(member(before, "scans"), member(now, "scans"), seconds),
            .lost = now.value("lost", std::uint64_t(0)),
            .clients = now.value("clients", std::uint64_t(0)),
            .casts_per_s = cast_rates(before, now, seconds)};
        const Json late = member(member(now, "lateness_ms"), "p99");
        if (late.is_number()) sensor.lateness_p99_ms = late.get<double>();
        rates.push_back(std::move(sensor));
    }
    return rates;
}

/// The object that `scipctl top --json` writes.
Json to_json(const SensorRates& sensor) {
    Json casts = Json::object();
    for (const auto& [backend, rate] : sensor.casts_per_s)
        casts[backend] = rate;
    return {{"name", sensor.name},       {"model", sensor.model},
            {"state", sensor.state},     {"scans_per_s", or_null(sensor.scans_per_s)},
            {"lost", sensor.lost},       {"lateness_p99_ms", or_null(sensor.lateness_p99_ms)},
            {"clients", sensor.clients}, {"casts_per_s", casts}};
}

using Json = ControlClient::Json;

constexpr std::chrono::seconds period{1};

struct TopOptions {
    bool once = false;
    bool json = false;
};

std::string number_text(std::optional<double> number, const char* format) {
    if (!number) return "-";
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), format, *number);
    return digits.data();
}

std::string casts_text(const SensorRates& sensor) {
    std::string casts;
    for (const auto& [backend, rate] : sensor.casts_per_s)
        casts += (casts.empty() ? "" : ", ") + backend + " " + number_text(rate, "%.1f");
    return casts.empty() ? "-" : casts;
}

std::string table_text(const Json& status, const std::vector<SensorRates>& sensors) {
    std::ostringstream out;
    out << "scene " << status.value("scene", "") << ", up for "
        << number_text(status.value("uptime_s", 0.0), "%.0f") << " s\n\n";
    std::vector<Row> rows{
        {"SENSOR", "MODEL", "STATE", "SCANS/S", "LOST", "LATE p99 ms", "CLIENTS", "CASTS/S"}};
    for (const SensorRates& sensor : sensors) {
        rows.push_back({sensor.name, sensor.model, sensor.state,
                        number_text(sensor.scans_per_s, "%.1f"), std::to_string(sensor.lost),
                        number_text(sensor.lateness_p99_ms, "%.2f"), std::to_string(sensor.clients),
                        casts_text(sensor)});
    }
    print_table(out, std::move(rows));
    return out.str();
}

std::string json_row(const Json& status, const std::vector<SensorRates>& sensors) {
    Json list = Json::array();
    for (const SensorRates& sensor : sensors)
        list.push_back(to_json(sensor));
    return json_text({{"uptime_s", status.value("uptime_s", 0.0)}, {"sensors", list}}) + "\n";
}

/// As much of the text as the terminal has room for, in the place of what stood there.
void draw_table(const std::string& text) {
    const TerminalSize size = terminal_size();
    std::istringstream lines(text);
    SafeOutput::write_as_is(std::cout, "\x1b[H");
    int left = size.rows - 1;  // the cursor needs one
    for (std::string line; left > 0 && std::getline(lines, line); --left) {
        SafeOutput::write_as_is(std::cout, "\x1b[K");
        std::cout << line.substr(0, static_cast<std::size_t>(size.columns)) << '\n';
    }
    SafeOutput::write_as_is(std::cout, "\x1b[J");
    std::cout.flush();
}

void show_top(const ControlOptions& control, const TopOptions& options) {
    ControlClient client(control.socket);
    Json earlier = client.get("/status");
    Keyboard keyboard;
    const bool live = !options.once && !options.json && draws_on_terminal();
    while (!keyboard.ends_within(period)) {
        Json now = client.get("/status");
        const std::vector<SensorRates> rates = rates_between(earlier, now);
        const std::string shown = options.json ? json_row(now, rates) : table_text(now, rates);
        live ? draw_table(shown + "\nq ends\n") : void(std::cout << shown << std::flush);
        if (options.once || !std::cout) break;
        earlier = std::move(now);
    }
}

}  // namespace

void add_top_command(CLI::App& program, const ControlOptions& control) {
    auto* const command =
        program.add_subcommand("top", "show the state of the sensors live, until q is pressed");
    const auto options = std::make_shared<TopOptions>();
    command->add_flag("--once", options->once, "show one table, of one second, then exit");
    command->add_flag("--json", options->json, "a JSON document each second, on a line");
    command->callback([&control, options] { show_top(control, *options); });
}

}  // namespace scipd::tools
