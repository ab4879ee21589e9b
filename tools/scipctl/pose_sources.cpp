// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipctl pose sources`: what comes from where, and what does not.
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tools/control_client.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// A number with its unit, or a dash where there is none.
std::string figure(const Json& source, const char* key, const char* format) {
    const Json& number = source.at(key);
    if (number.is_null()) return "-";
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format, number.get<double>());
    return text.data();
}

std::string late(const Json& source) {
    if (source.at("late_ms").is_null()) return "-";
    return figure(source, "late_ms", "%.1f") + " / " + figure(source, "most_late_ms", "%.1f");
}

void print_sources(const Json& sources) {
    std::vector<Row> rows{{"ROBOT", "SOURCE", "TYPE", "CAME", "REFUSED", "LOST", "RATE Hz", "LAST",
                           "LATE mean/max ms"}};
    for (const Json& source : sources) {
        rows.push_back({source.at("robot"), source.at("source"),
                        source.at("type").is_null() ? "-" : source.at("type").get<std::string>(),
                        source.at("messages").dump(), source.at("refused").dump(),
                        source.at("lost").dump(), figure(source, "rate_hz", "%.1f"),
                        figure(source, "age_s", "%.1f s ago"), late(source)});
    }
    print_table(std::cout, rows);
    for (const Json& source : sources) {
        for (const Json& trouble : source.at("troubles"))
            std::cout << "warning: " << source.at("robot").get<std::string>() << ": "
                      << trouble.get<std::string>() << '\n';
    }
}

void show_sources(const ControlOptions& control, bool json) {
    ControlClient client(control.socket);
    const Json sources = client.get("/status").at("poses").at("sources");
    if (json) {
        std::cout << json_text({{"sources", sources}}, 2) << '\n';
    } else if (sources.empty()) {
        std::cout << "no robot has a source of poses: see --poses of scipd\n";
    } else {
        print_sources(sources);
    }
}

}  // namespace

void add_pose_sources_command(CLI::App& pose, const ControlOptions& control) {
    auto* const command = pose.add_subcommand(
        "sources", "show what each source of poses delivers: rate, lateness and missing names");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "as JSON");
    command->callback([&control, json] { show_sources(control, *json); });
}

}  // namespace scipd::tools
