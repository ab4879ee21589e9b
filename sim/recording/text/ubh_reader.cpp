// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <utility>

#include "sim/recording/text/text_recording.h"
#include "sim/recording/text/ubh.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

/// 2026-01-31 12:00:00.000, or with colons everywhere, as versions before 1.2.5 have it.
std::optional<HostTime> parse_log_time(const std::string& text) {
    std::tm local{};
    int ms = 0;
    const auto reads = [&](const char* pattern) {
        const int numbers =
            std::sscanf(text.c_str(), pattern, &local.tm_year, &local.tm_mon, &local.tm_mday,
                        &local.tm_hour, &local.tm_min, &local.tm_sec, &ms);
        return numbers >= 6;
    };
    if (!reads("%4d-%2d-%2d %2d:%2d:%2d.%3d") && !reads("%4d:%2d:%2d:%2d:%2d:%2d:%3d"))
        return std::nullopt;
    local.tm_year -= 1900;
    local.tm_mon -= 1;
    local.tm_isdst = -1;
    const std::time_t unix_s = std::mktime(&local);
    return host_time_at(unix_s, std::int64_t{ms} * 1'000'000);
}

std::optional<int> count_in(std::string_view value) {
    const auto number = parse_number(value);
    if (!number || *number < 0 || *number > 1e6) return std::nullopt;
    return static_cast<int>(*number);
}

std::string_view take_until(std::string_view& text, char mark) {
    const std::string_view taken = text.substr(0, text.find(mark));
    text.remove_prefix(std::min(taken.size() + 1, text.size()));
    return taken;
}

/// One step: mm, mm|intensity, or several of them.
Expected<> append_step(std::string_view step, RecordedScan& scan) {
    const std::string whole(step);
    while (!step.empty()) {
        std::string_view echo = take_until(step, '&');
        const bool has_intensity = echo.find('|') != echo.npos;
        const auto range = parse_number(take_until(echo, '|'));
        const auto intensity = parse_number(echo);
        if (!range || (has_intensity && !intensity))
            return refuse(quote(whole) + " is no mm, mm|intensity or mm&mm");
        scan.ranges.push_back(*range);
        if (has_intensity) scan.intensities.push_back(*intensity);
    }
    scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    return {};
}

class Ubh final : public TextRecording {
  public:
    explicit Ubh(InputFile file) : TextRecording("ubh", std::move(file)) {
        add_stream({.name = "scanner", .type = "UBH"});
    }

  private:
    Next take(std::string_view line) override {
        line = trimmed(line);
        if (line.starts_with('[') && line.ends_with(']')) {
            key_ = line.substr(1, line.size() - 2);
            return std::nullopt;
        }
        if (key_.empty() && !line.empty())
            return refuse("must be a key in brackets, such as [model], or the value below one");
        const std::string key = std::exchange(key_, {});
        if (key == "scan") return take_scan(line);
        if (const auto read = read_value(key, std::string(line)); !read)
            return tl::unexpected(read.error());
        return std::nullopt;
    }

    Expected<> read_value(const std::string& key, const std::string& value) {
        ScannerIdentity& identity = stream(0).identity;
        if (key == "timestamp") {
            const auto stamp = parse_number(value);
            if (!stamp || *stamp < 0 || *stamp > 0xFFFFFFFF)
                return refuse("a timestamp must be a number of milliseconds, not " + quote(value));
            stamp_ms_ = static_cast<std::uint32_t>(*stamp);
        } else if (key == "logtime") {
            host_time_ = parse_log_time(value);
        } else if (key == "model") {
            identity.model = value;
        } else if (key == "serialNumber") {
            identity.serial = value;
        } else if (key == "firmwareVersion") {
            identity.firmware = value;
        } else if (key == "captureMode") {
            has_echoes_ = value.starts_with('H') || value.starts_with('N');
        } else {
            read_number(key, value, identity);
        }
        return {};
    }

    void read_number(const std::string& key, const std::string& value, ScannerIdentity& identity) {
        const auto count = count_in(value);
        if (!count) return;
        if (key == "startStep") directions_.first_step = count;
        if (key == "grouping") directions_.cluster = std::max(*count, 1);
        if (key == "frontStep") identity.front_step = count;
        if (key == "totalSteps") identity.steps_per_turn = count;
        if (key == "minDistance") identity.min_range_m = *count / 1000.0;
        if (key == "maxDistance") identity.max_range_m = *count / 1000.0;
        if (key == "motorSpeed") identity.rpm = count;
    }

    Next take_scan(std::string_view values) {
        RecordedScan scan;
        scan.stamp_ms = std::exchange(stamp_ms_, std::nullopt);
        scan.host_time = std::exchange(host_time_, std::nullopt);
        scan.directions = with_angles(directions_, stream(0).identity);
        if (values.ends_with(';')) values.remove_suffix(1);
        for (bool more = true; more;) {
            more = values.find(';') != values.npos;
            const auto appended = append_step(take_until(values, ';'), scan);
            if (!appended) return tl::unexpected(appended.error());
        }
        if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
            return refuse("some values have an intensity and some have none");
        // Where no step has several, they are the only ones.
        if (!has_echoes_ && scan.echo_ends.size() == scan.ranges.size()) scan.echo_ends.clear();
        return RecordedItem{0, std::move(scan)};
    }

    std::string key_;  ///< whose value comes next
    Directions directions_;
    bool has_echoes_ = false;
    std::optional<std::uint32_t> stamp_ms_;
    std::optional<HostTime> host_time_;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_ubh(InputFile file) {
    return std::make_unique<Ubh>(std::move(file));
}

}  // namespace scipd::sim
