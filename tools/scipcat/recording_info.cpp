// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "daemon/models/best_fit.h"
#include "tools/analysis/beam_statistics.h"
#include "tools/formatted.h"
#include "tools/local_time.h"
#include "tools/options.h"
#include "tools/scipcat/compare/comparison_words.h"
#include "tools/scipcat/scipcat_commands.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;
using comparing::share_list;
using sim::RecordedScan;
using sim::ScannerIdentity;
using std::chrono::duration;

constexpr std::size_t most_gaps_shown = 5;

/// Missing scans: the time between two scans is more than one and a half times what it mostly is.
struct RecordingGap {
    std::size_t after_scan = 0;  ///< counts from 1
    double seconds = 0;          ///< between that scan and the next
};

struct StreamSummary {
    sim::RecordedStream stream;
    std::size_t scans = 0;
    std::size_t steps = 0;  ///< of the longest scan
    double seconds = 0;     ///< from the first scan to the last, by the scanner's clock if there is
                            ///< one, else by the host's
    std::optional<sim::HostTime> begin;  ///< of the first scan
    std::size_t stamped = 0;             ///< scans whose time is the stamp in their header
    std::size_t logged = 0;              ///< scans whose time is that of the log
    bool intensities = false;            ///< in any scan
    bool echoes = false;
    bool metres = false;
    bool codes = false;        ///< some are numbers, as the scanner sent them
    CodeShares no_distance;    ///< share of each class of codes among the first echoes
    std::string replays_as;    ///< the model of a replay, or empty if the recording has no angles
    std::string why_recorded;  ///< if that is `recorded`
    std::vector<RecordingGap> gaps;
};

struct RecordingSummary {
    std::string format;
    std::vector<StreamSummary> streams;
    std::vector<std::string> warnings;
};

/// Time by the scanner's clock; nullopt if it is not known or went back, as at a new start.
std::optional<double> stamped_seconds_between(const RecordedScan& before,
                                              const RecordedScan& scan) {
    constexpr std::uint32_t stamps = 1U << 24;  // a stamp of 24 bits wraps after 4.66 hours
    if (before.stamp_us && scan.stamp_us && *scan.stamp_us >= *before.stamp_us)
        return static_cast<double>(*scan.stamp_us - *before.stamp_us) / 1e6;
    if (before.stamp_ms && scan.stamp_ms) {
        const std::uint32_t forward_ms = (*scan.stamp_ms - *before.stamp_ms) % stamps;
        if (forward_ms < stamps / 2) return forward_ms / 1e3;
    }
    return std::nullopt;
}

/// The seconds from one scan to the next, not negative; nullopt where neither clock says.
std::optional<double> seconds_between(const RecordedScan& before, const RecordedScan& scan) {
    if (const auto stamped = stamped_seconds_between(before, scan)) return stamped;
    if (before.host_time && scan.host_time)
        return std::max(duration<double>(*scan.host_time - *before.host_time).count(), 0.0);
    return std::nullopt;
}

class StreamReader {
  public:
    void take(const sim::RecordedItem& item, RecordedScan scan, const ScannerIdentity& identity) {
        ++summary_.scans;
        if (item.stamped) ++summary_.stamped;
        if (item.logged && !item.stamped) ++summary_.logged;
        summary_.steps = std::max(summary_.steps, scan.steps());
        summary_.intensities = summary_.intensities || !scan.intensities.empty();
        summary_.echoes = summary_.echoes || scan.has_echoes();
        summary_.metres = scan.unit == sim::RangeUnit::metres;
        summary_.codes = summary_.codes || !summary_.metres;
        for (std::size_t beam = 0; beam < scan.steps(); ++beam)
            count(reading_at(scan, beam, Echo::first, identity).code);
        readings_ += scan.steps();
        if (summary_.scans == 1) {
            summary_.begin = scan.host_time;
            directions_ = scan.directions;
            first_steps_ = scan.steps();
        }
        if (summary_.scans > 1) intervals_s_.push_back(seconds_between(last_, scan).value_or(0));
        last_ = std::move(scan);
    }

    [[nodiscard]] StreamSummary finish(const sim::RecordedStream& stream) && {
        summary_.stream = stream;
        for (const double interval_s : intervals_s_)
            summary_.seconds += interval_s;
        for (auto& [code, share] : summary_.no_distance)
            share /= static_cast<double>(readings_);
        find_gaps();
        find_model();
        return std::move(summary_);
    }

  private:
    void count(Code code) {
        if (code == codes::distance) return;
        summary_.codes = summary_.codes || code >= 0;
        summary_.no_distance[class_of(code)] += 1;
    }

    void find_gaps() {
        const double usual_s = median_of(intervals_s_);
        if (!(usual_s > 0)) return;
        for (std::size_t i = 0; i < intervals_s_.size(); ++i) {
            if (intervals_s_[i] > 1.5 * usual_s) summary_.gaps.push_back({i + 1, intervals_s_[i]});
        }
    }

    /// Finds the model as scipd --replay without one does.
    void find_model() {
        const ScannerIdentity& identity = summary_.stream.identity;
        const daemon::Model* const named = daemon::model_named_in(identity.model);
        if (named != nullptr) summary_.replays_as = named->profile.name;
        if (named != nullptr || !directions_.first_rad || !directions_.increment_rad) return;
        const bool timed = !intervals_s_.empty() && intervals_s_.front() > 0;
        const sim::Lidar lidar = daemon::recorded_lidar(directions_, first_steps_, identity,
                                                        timed ? 1 / intervals_s_.front() : 0);
        summary_.replays_as = daemon::recorded_model(lidar).profile.name;
        if (summary_.replays_as != "recorded") return;
        summary_.why_recorded = "the nearest product, " + daemon::best_fit(lidar).profile.name +
                                ", has " + daemon::missing_in_best_fit(lidar);
    }

    StreamSummary summary_;
    sim::Directions directions_;   ///< of the first scan
    std::size_t first_steps_ = 0;  ///< of it
    std::size_t readings_ = 0;
    RecordedScan last_;
    std::vector<double> intervals_s_;
};

RecordingSummary summary_of(sim::Recording& recording) {
    std::vector<StreamReader> readers;
    for (;;) {
        auto item = recording.next();
        if (!item) throw WrongInput(item.error().why);
        readers.resize(recording.streams().size());
        if (!*item) break;
        const std::size_t stream = (*item)->stream;
        readers[stream].take(**item, std::move(std::get<RecordedScan>((*item)->what)),
                             recording.streams()[stream].identity);
    }
    RecordingSummary summary{recording.format(), {}, recording.warnings()};
    for (std::size_t i = 0; i < readers.size(); ++i)
        summary.streams.push_back(std::move(readers[i]).finish(recording.streams()[i]));
    return summary;
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
    std::string text = summary.metres ? "metres" : "mm";
    if (summary.codes) text += " with the scanner's codes";
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
    if (!summary.no_distance.empty()) show_line("codes", share_list(summary.no_distance));
    if (identity.model.empty() || !summary.why_recorded.empty())
        show_line("replays as", summary.replays_as + (summary.why_recorded.empty() ? "" : ": ") +
                                    summary.why_recorded);
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
    object["no_distance"] = Json::object();
    for (const auto& [code, share] : summary.no_distance)
        object["no_distance"][name_of_code(code)] = share;
    object["replays_as"] = {{"model", text_json(summary.replays_as)},
                            {"why", text_json(summary.why_recorded)}};
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
    const RecordingSummary summary = summary_of(*open_recorded(target));
    if (!json) return show(target, summary);
    std::cout << as_json(summary).dump(2, ' ', true, nlohmann::json::error_handler_t::replace)
              << '\n';
}

}  // namespace scipd::tools
