// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service/log_line.h"

#include <array>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

namespace scipd::daemon {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view separator = ": ";

/// RFC 3339, to the millisecond.
std::string in_utc(std::chrono::system_clock::time_point time) {
    const auto since = time.time_since_epoch();
    const auto whole = std::chrono::floor<std::chrono::seconds>(since);
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(since - whole);
    const auto seconds = static_cast<std::time_t>(whole.count());
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    std::array<char, 32> text{};
    const std::size_t size = std::strftime(text.data(), text.size(), "%FT%T", &utc);
    std::snprintf(text.data() + size, text.size() - size, ".%03dZ", static_cast<int>(rest.count()));
    return text.data();
}

}  // namespace

std::string_view sensor_of(std::string_view message, const Sensors& sensors) {
    const std::string_view name = message.substr(0, message.find(separator));
    return name.size() < message.size() && sensors.contains(name) ? name : std::string_view{};
}

std::string json_log_line(const LogEntry& entry, const Sensors& sensors) {
    Json line{{"time", in_utc(entry.time)}, {"level", entry.level}};
    std::string_view message = entry.message;
    if (const std::string_view sensor = sensor_of(message, sensors); !sensor.empty()) {
        line["sensor"] = sensor;
        message.remove_prefix(sensor.size() + separator.size());
    }
    line["message"] = message;
    constexpr bool ascii = true;
    return line.dump(-1, ' ', ascii, Json::error_handler_t::replace);
}

}  // namespace scipd::daemon
