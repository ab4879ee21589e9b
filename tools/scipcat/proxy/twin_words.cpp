// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

#include "tools/scipcat/proxy/twin_comparison.h"

namespace scipd::tools {
namespace {

std::string steps_of(const TwinDifference& difference) {
    return "steps " + std::to_string(difference.from) + "-" + std::to_string(difference.to);
}

std::string metres(double mm) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f m", mm / 1000.0);
    return text;
}

/// 14:03:07, as clocks on the wall here.
std::string local_time(sim::HostTime time) {
    const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(time);
    const std::time_t unix_s = seconds.time_since_epoch().count();
    std::tm local{};
    localtime_r(&unix_s, &local);
    char text[16];
    std::strftime(text, sizeof text, "%H:%M:%S", &local);
    return text;
}

std::string how(const TwinDifference& difference) {
    if (difference.codes) {
        char text[64];
        std::snprintf(text, sizeof text, " read %.0f, the twin's %.0f", difference.scanner,
                      difference.twin);
        return text;
    }
    const double by_mm = difference.by_mm();
    return (by_mm < 0 ? " nearer by " : " farther by ") + metres(std::abs(by_mm));
}

}  // namespace

std::string sentence_of(const TwinChange& change) {
    const TwinDifference& difference = change.difference;
    return steps_of(difference) +
           (change.begins ? how(difference) : " agree with the twin's again") + ", since scan " +
           std::to_string(difference.scan) + " at " + local_time(difference.time);
}

std::string json_of(const TwinChange& change) {
    const TwinDifference& difference = change.difference;
    const std::chrono::duration<double> unix_s = difference.time.time_since_epoch();
    const nlohmann::ordered_json object{
        {"differs", change.begins}, {"from", difference.from},
        {"to", difference.to},      {"what", difference.codes ? "codes" : "mean"},
        {"a", difference.scanner},  {"b", difference.twin},
        {"scan", difference.scan},  {"time_s", unix_s.count()}};
    return object.dump();
}

}  // namespace scipd::tools
