// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

template <class Value>
struct UbhKey {
    using Member = Value ScannerIdentity::*;
    const char* name;
    Member value;
    double per_unit = 1;  ///< of the identity: mm per m
};
constexpr std::array text_keys = {
    UbhKey<std::string>{"model", &ScannerIdentity::model},
    UbhKey<std::string>{"serialNumber", &ScannerIdentity::serial},
    UbhKey<std::string>{"firmwareVersion", &ScannerIdentity::firmware}};
using StepKey = UbhKey<std::optional<int>>;
constexpr std::array step_keys = {StepKey{"frontStep", &ScannerIdentity::front_step},
                                  StepKey{"totalSteps", &ScannerIdentity::steps_per_turn}};
using NumberKey = UbhKey<std::optional<double>>;
constexpr std::array number_keys = {NumberKey{"minDistance", &ScannerIdentity::min_range_m, 1000},
                                    NumberKey{"maxDistance", &ScannerIdentity::max_range_m, 1000},
                                    NumberKey{"motorSpeed", &ScannerIdentity::rpm}};

/// 2026-01-31 12:00:00.000, or with colons everywhere, as in versions before 1.2.5.
std::optional<HostTime> parse_log_time(const std::string& text) {
    std::tm local{};
    int ms = 0;
    const auto reads = [&](const char* pattern) {
        return std::sscanf(text.c_str(), pattern, &local.tm_year, &local.tm_mon, &local.tm_mday,
                           &local.tm_hour, &local.tm_min, &local.tm_sec, &ms) >= 6;
    };
    if (!reads("%4d-%2d-%2d %2d:%2d:%2d.%3d") && !reads("%4d:%2d:%2d:%2d:%2d:%2d:%3d"))
        return std::nullopt;
    local.tm_year -= 1900;
    local.tm_mon -= 1;
    local.tm_isdst = -1;
    const std::time_t unix_s = std::mktime(&local);
    return host_time_at(unix_s, std::int64_t{ms} * 1'000'000);
}

std::string log_time(HostTime time) {
    using std::chrono::floor;
    const auto ms = floor<std::chrono::milliseconds>(time);
    const auto s = floor<std::chrono::seconds>(ms);
    const std::time_t unix_s = s.time_since_epoch().count();
    std::tm local{};
    localtime_r(&unix_s, &local);
    std::ostringstream text;
    text << std::put_time(&local, "%F %T.") << std::setw(3) << std::setfill('0')
         << (ms - s).count();
    return text.str();
}

/// Appends a step: mm, mm|intensity, or several of them.
Expected<> append_step(std::string_view step, RecordedScan& scan) {
    const std::string whole(step);
    while (!step.empty()) {
        std::string_view echo = take_until(step, "&");
        const bool has_intensity = echo.find('|') != echo.npos;
        const auto range = parse_number(take_until(echo, "|"));
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
        return key == "scan" ? take_scan(line) : take_value(key, std::string(line));
    }

    Next take_value(const std::string& key, const std::string& value) {
        const auto number = parse_number(value);
        if (key == "timestamp") {
            if (!number || *number < 0 || *number > 0xFFFFFFFF)
                return refuse("a timestamp must be a number of milliseconds, not " + quote(value));
            stamp_ms_ = static_cast<std::uint32_t>(*number);
        }
        if (key == "logtime") host_time_ = parse_log_time(value);
        if (key == "captureMode") has_echoes_ = value.starts_with('H') || value.starts_with('N');
        for (const auto& text : text_keys) {
            if (key == text.name) stream(0).identity.*text.value = value;
        }
        if (!number || *number < 0 || *number > 1e6) return std::nullopt;
        const int count = static_cast<int>(*number);
        if (key == "startStep") directions_.first_step = count;
        if (key == "grouping") directions_.cluster = std::max(count, 1);
        for (const auto& step : step_keys) {
            if (key == step.name) stream(0).identity.*step.value = count;
        }
        for (const auto& size : number_keys) {
            if (key == size.name) stream(0).identity.*size.value = count / size.per_unit;
        }
        return std::nullopt;
    }

    Next take_scan(std::string_view values) {
        RecordedScan scan;
        scan.stamp_ms = std::exchange(stamp_ms_, std::nullopt);
        scan.host_time = std::exchange(host_time_, std::nullopt);
        scan.directions = with_angles(directions_, stream(0).identity);
        if (values.ends_with(';')) values.remove_suffix(1);
        for (bool more = true; more;) {
            more = values.find(';') != values.npos;
            const auto appended = append_step(take_until(values, ";"), scan);
            if (!appended) return tl::unexpected(appended.error());
        }
        if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
            return refuse("some values have an intensity and some have none");
        // One value a step: no echoes, unless the mode asks for them.
        if (!has_echoes_ && scan.echo_ends.size() == scan.ranges.size()) scan.echo_ends.clear();
        return RecordedItem{0, std::move(scan)};
    }

    std::string key_;  ///< of the value in the next line
    Directions directions_;
    bool has_echoes_ = false;
    std::optional<std::uint32_t> stamp_ms_;
    std::optional<HostTime> host_time_;
};

std::string pair(const std::string& key, const std::string& value) {
    return "[" + key + "]\n" + value + "\n";
}

std::string values_of(const RecordedScan& scan) {
    std::string text;
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        const auto ranges = scan.ranges_of(step);
        const auto intensities = scan.intensities_of(step);
        if (step > 0) text += ';';
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            if (i > 0) text += '&';
            text += whole_text(ranges[i]);
            if (!intensities.empty()) text += '|' + whole_text(intensities[i]);
        }
    }
    return text;
}

class UbhWriter final : public TextRecordingWriter {
  public:
    UbhWriter(const std::filesystem::path& path, ScannerIdentity identity, std::string recorder)
        : TextRecordingWriter(path, std::move(identity)), recorder_(std::move(recorder)) {}

  private:
    std::string head_of(const RecordedScan& scan) override {
        const int first = scan.directions.first_step.value_or(0);
        const int cluster = scan.directions.cluster;
        const int steps = static_cast<int>(scan.steps()) * cluster;
        std::string text = pair("appName", "scipd") + pair("appVersion", recorder_);
        for (const auto& key : text_keys)
            text += pair(key.name, identity().*key.value);
        // SCIP's requests for such scans.
        const std::string mode = std::string(scan.has_echoes() ? "N" : "M") +
                                 (scan.intensities.empty() ? "D" : "E") + "_Capture_mode";
        text += pair("captureMode", mode) + pair("startStep", std::to_string(first)) +
                pair("endStep", std::to_string(first + steps - 1)) +
                pair("grouping", std::to_string(cluster));
        for (const auto& key : step_keys) {
            if (const auto& step = identity().*key.value)
                text += pair(key.name, std::to_string(*step));
        }
        for (const auto& key : number_keys) {
            if (const auto& number = identity().*key.value)
                text += pair(key.name, whole_text(*number * key.per_unit));
        }
        if (identity().rpm.value_or(0) > 0)
            text += pair("scanMsec", whole_text(60'000 / *identity().rpm));
        return text;
    }

    std::string text_of(const RecordedScan& scan) override {
        std::string text = pair("timestamp", std::to_string(scan.stamp_ms.value_or(0)));
        if (scan.host_time) text += pair("logtime", log_time(*scan.host_time));
        return text + pair("scan", values_of(scan));
    }

    std::string recorder_;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_ubh(InputFile file) {
    return std::make_unique<Ubh>(std::move(file));
}

std::unique_ptr<RecordingWriter> create_ubh(const std::filesystem::path& path,
                                            ScannerIdentity identity, std::string recorder) {
    return std::make_unique<UbhWriter>(path, std::move(identity), std::move(recorder));
}

}  // namespace scipd::sim
