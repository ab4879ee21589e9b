// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/log_line.h"

#include <array>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

namespace scipd::daemon {
namespace {

using Json = nlohmann::ordered_json;

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

std::string json_log_line(const LogEntry& entry,
                          const std::set<std::string, std::less<>>& sensors) {
    constexpr std::string_view separator = ": ";
    Json line{{"time", in_utc(entry.time)}, {"level", entry.level}};
    std::string_view message = entry.message;
    const auto end = message.find(separator);
    if (end != message.npos && sensors.contains(message.substr(0, end))) {
        line["sensor"] = message.substr(0, end);
        message.remove_prefix(end + separator.size());
    }
    line["message"] = message;
    constexpr bool ascii = true;
    return line.dump(-1, ' ', ascii, Json::error_handler_t::replace);
}

}  // namespace scipd::daemon
