// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A table of the sensors that is drawn anew each second, as `top` has one of processes.
#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tools/control_client.h"
#include "tools/keyboard.h"
#include "tools/safe_output.h"
#include "tools/scipctl/rates.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

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
