// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <array>
#include <cstdio>
#include <ctime>
#include <utility>

#include "sim/recording/file/growing_file.h"
#include "sim/recording/text/text_values.h"
#include "sim/recording/text/ubh.h"

namespace scipd::sim {
namespace {

/// As in 2026-01-31 12:00:00.000, local time.
std::string log_time(HostTime time) {
    using std::chrono::floor;
    const auto ms = floor<std::chrono::milliseconds>(time);
    const auto s = floor<std::chrono::seconds>(ms);
    const std::time_t unix_s = s.time_since_epoch().count();
    std::tm local{};
    localtime_r(&unix_s, &local);
    std::array<char, 40> date{};
    std::strftime(date.data(), date.size(), "%F %T", &local);
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%s.%03d", date.data(),
                  static_cast<int>((ms - s).count()));
    return text.data();
}

/// What SCIP calls the requests for such scans.
std::string capture_mode(const RecordedScan& scan) {
    return std::string(scan.has_echoes() ? "N" : "M") + (scan.intensities.empty() ? "D" : "E") +
           "_Capture_mode";
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

class UbhWriter final : public RecordingWriter {
  public:
    UbhWriter(const std::filesystem::path& path, ScannerIdentity identity, std::string recorder)
        : file_(path), identity_(std::move(identity)), recorder_(std::move(recorder)) {}

    void write(const RecordedScan& scan) override {
        std::string text = std::exchange(begun_, true) ? "" : head(scan);
        text += pair("timestamp", std::to_string(scan.stamp_ms.value_or(0)));
        if (scan.host_time) text += pair("logtime", log_time(*scan.host_time));
        text += pair("scan", values_of(scan));
        file_.write(text);
        file_.flush();
    }

  private:
    static std::string pair(const std::string& key, const std::string& value) {
        return "[" + key + "]\n" + value + "\n";
    }

    [[nodiscard]] std::string head(const RecordedScan& scan) const {
        const int first = scan.directions.first_step.value_or(0);
        const int cluster = scan.directions.cluster;
        const int steps = static_cast<int>(scan.steps()) * cluster;
        std::string text = pair("appName", "scipd") + pair("appVersion", recorder_) +
                           pair("model", identity_.model) + pair("serialNumber", identity_.serial) +
                           pair("firmwareVersion", identity_.firmware) +
                           pair("captureMode", capture_mode(scan)) +
                           pair("startStep", std::to_string(first)) +
                           pair("endStep", std::to_string(first + steps - 1)) +
                           pair("grouping", std::to_string(cluster));
        if (identity_.front_step) text += pair("frontStep", std::to_string(*identity_.front_step));
        if (identity_.steps_per_turn)
            text += pair("totalSteps", std::to_string(*identity_.steps_per_turn));
        if (identity_.min_range_m)
            text += pair("minDistance", whole_text(*identity_.min_range_m * 1e3));
        if (identity_.max_range_m)
            text += pair("maxDistance", whole_text(*identity_.max_range_m * 1e3));
        if (identity_.rpm.value_or(0) > 0) {
            text += pair("motorSpeed", whole_text(*identity_.rpm));
            text += pair("scanMsec", whole_text(60'000 / *identity_.rpm));
        }
        return text;
    }

    GrowingFile file_;
    ScannerIdentity identity_;
    std::string recorder_;
    bool begun_ = false;
};

}  // namespace

std::unique_ptr<RecordingWriter> create_ubh(const std::filesystem::path& path,
                                            ScannerIdentity identity, std::string recorder) {
    return std::make_unique<UbhWriter>(path, std::move(identity), std::move(recorder));
}

}  // namespace scipd::sim
