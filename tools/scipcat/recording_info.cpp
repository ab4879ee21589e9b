// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/recording_info.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/local_time.h"
#include "tools/options.h"
#include "tools/scipcat/recording_summary.h"
#include "tools/scipcat/recording_target.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;
using sim::ScannerIdentity;

constexpr std::size_t most_gaps_shown = 5;

template <typename... Values>
std::string formatted(const char* pattern, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

void show_line(const char* key, const std::string& value) {
    if (!value.empty()) std::cout << formatted("  %-12s", key) << value << '\n';
}

std::string range_text(const ScannerIdentity& identity) {
    if (!identity.min_range_m && !identity.max_range_m) return {};
    return formatted("%.3f to %.3f m", identity.min_range_m.value_or(0),
                     identity.max_range_m.value_or(0));
}

std::string length_text(const StreamSummary& summary) {
    std::string text = formatted("%zu", summary.scans);
    if (summary.scans == 0) return text;
    text += formatted(" of %zu steps", summary.steps);
    if (summary.seconds > 0)
        text += formatted(", %.3f s, %.2f a second", summary.seconds,
                          static_cast<double>(summary.scans - 1) / summary.seconds);
    if (summary.begin) text += ", from " + local_time(*summary.begin);
    return text;
}

std::string values_text(const StreamSummary& summary) {
    std::string text = summary.codes ? "mm with the scanner's codes" : "metres";
    if (summary.echoes) text += ", all echoes";
    if (summary.intensities) text += ", intensities";
    return text;
}

/// Empty: the format has one time only.
std::string times_text(const StreamSummary& summary) {
    if (summary.stamped == 0) return summary.logged == 0 ? "" : "log time";
    if (summary.logged == 0) return "header stamps";
    return formatted("header stamps, and log time of %zu scans without", summary.logged);
}

std::string gaps_text(const StreamSummary& summary) {
    std::string text;
    for (std::size_t i = 0; i < std::min(summary.gaps.size(), most_gaps_shown); ++i) {
        const RecordingGap& gap = summary.gaps[i];
        text +=
            formatted("%s%.3f s after scan %zu", i == 0 ? "" : ", ", gap.seconds, gap.after_scan);
    }
    if (summary.gaps.size() > most_gaps_shown)
        text += formatted(" and %zu more", summary.gaps.size() - most_gaps_shown);
    return text;
}

void show_stream(const StreamSummary& summary) {
    const ScannerIdentity& identity = summary.stream.identity;
    std::cout << summary.stream.name << " (" << summary.stream.type << ")\n";
    show_line("model", identity.model);
    show_line("vendor", value_of(identity.version, "VEND"));
    show_line("product", value_of(identity.version, "PROD"));
    show_line("serial", identity.serial);
    show_line("firmware", identity.firmware);
    show_line("range", range_text(identity));
    show_line("scans", length_text(summary));
    if (summary.scans > 0) show_line("values", values_text(summary));
    show_line("times", times_text(summary));
    show_line("gaps", gaps_text(summary));
    show_line("health", value_of(identity.state, "STAT"));
}

void show(const std::string& target, const RecordingSummary& summary) {
    std::cout << target << ": " << summary.format << '\n';
    for (const StreamSummary& stream : summary.streams)
        show_stream(stream);
    if (summary.streams.empty()) std::cout << "It holds no scans.\n";
    for (const std::string& warning : summary.warnings)
        std::cout << warning << '\n';
}

template <class Value>
Json known(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json text_json(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json millimetres(const std::optional<double>& range_m) {
    return range_m ? Json(std::llround(*range_m * 1000)) : Json(nullptr);
}

Json device_json(const ScannerIdentity& identity) {
    return {
        {"model", text_json(identity.model)},
        {"vendor", text_json(value_of(identity.version, "VEND"))},
        {"product", text_json(value_of(identity.version, "PROD"))},
        {"firmware", text_json(identity.firmware)},
        {"serial", text_json(identity.serial)},
        {"dmin_mm", millimetres(identity.min_range_m)},
        {"dmax_mm", millimetres(identity.max_range_m)},
        {"ares", known(identity.steps_per_turn)},
        {"afrt", known(identity.front_step)},
        {"scan_rpm", known(identity.rpm)},
        {"health", text_json(value_of(identity.state, "STAT"))},
    };
}

/// Adds what is known of a stream.
void add_stream(Json& object, const StreamSummary& summary) {
    object["device"] = device_json(summary.stream.identity);
    object["scans"] = summary.scans;
    object["steps"] = summary.steps;
    object["seconds"] = summary.seconds;
    object["times"] = {{"stamped", summary.stamped}, {"logged", summary.logged}};
    object["intensities"] = summary.intensities;
    object["echoes"] = summary.echoes;
    object["codes"] = summary.codes;
    object["gaps"] = Json::array();
    for (const RecordingGap& gap : summary.gaps)
        object["gaps"].push_back({{"after_scan", gap.after_scan}, {"seconds", gap.seconds}});
}

/// The first stream at the top, since most recordings have one; all of them in a list.
Json as_json(const RecordingSummary& summary) {
    Json document{{"format", summary.format}};
    add_stream(document, summary.streams.empty() ? StreamSummary{} : summary.streams.front());
    document["streams"] = Json::array();
    for (const StreamSummary& stream : summary.streams) {
        Json object{{"name", stream.stream.name}, {"type", stream.stream.type}};
        add_stream(object, stream);
        document["streams"].push_back(std::move(object));
    }
    document["warnings"] = summary.warnings;
    return document;
}

}  // namespace

void show_recording(const std::string& target, bool json) {
    const auto summary = summarize(*open_recorded(target));
    if (!summary) throw WrongInput(summary.error().why);
    if (!json) return show(target, *summary);
    std::cout << as_json(*summary).dump(2, ' ', true, nlohmann::json::error_handler_t::replace)
              << '\n';
}

}  // namespace scipd::tools
