// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/carmen.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "sim/recording/text/text_recording.h"
#include "sim/recording/text/text_values.h"
#include "sim/recording/text/word_line.h"

namespace scipd::sim {
namespace {

constexpr std::array<std::string_view, 12> messages = {
    "PARAM",  "SYNC",   "ODOM",     "TRUEPOS",    "FLASER",  "RLASER",
    "LASER3", "LASER4", "RAWLASER", "ROBOTLASER", "NMEAGGA", "NMEARMC"};

/// "RAWLASER2" without its number.
std::string_view kind_of(std::string_view message) {
    for (const std::string_view kind : {"RAWLASER", "ROBOTLASER"}) {
        const std::string_view number = message.substr(std::min(kind.size(), message.size()));
        if (message.starts_with(kind) && number.size() == 1 && number >= "1" && number <= "9")
            return kind;
    }
    return message;
}

/// FLASER and RLASER say no angles: their lasers look over half a turn, from the right to the left.
/// 181 and 361 values have one at both ends, 180 and 360 one at the right alone.
Directions half_turn(std::size_t values) {
    const auto count = static_cast<double>(std::max<std::size_t>(values, 2));
    const double gaps = values % 2 == 1 ? count - 1 : count;
    return {.first_rad = -std::numbers::pi / 2, .increment_rad = std::numbers::pi / gaps};
}

class Carmen final : public TextRecording {
  public:
    explicit Carmen(InputFile file) : TextRecording("carmen", std::move(file)) {}

  private:
    Next take(std::string_view line) override {
        WordLine words(line);
        const std::string message(words.word());
        const std::string_view kind = kind_of(message);
        const bool old = kind == "FLASER" || kind == "RLASER";
        if (!old && kind != "RAWLASER" && kind != "ROBOTLASER") return std::nullopt;

        RecordedScan scan{.unit = RangeUnit::metres};
        double max_range_m = 0;
        if (!old) max_range_m = read_config(words, scan);
        scan.ranges = words.numbers(words.count());
        if (old) scan.directions = half_turn(scan.ranges.size());
        if (!old) read_remissions(words, scan);
        // The laser's own, before the robot's.
        if (kind != "RAWLASER" && words.left() >= 6) scan.pose = pose_in(words);
        // The line ends in the time of the message, the host, and the time since the log began.
        scan.host_time = host_time_in(words.from_end(2));
        if (words.wrong() || !scan.host_time)
            return refuse(message + " must have as many numbers as it says, and end in a time");
        return RecordedItem{stream_of(message, max_range_m), std::move(scan)};
    }

    /// Returns the largest range.
    static double read_config(WordLine& words, RecordedScan& scan) {
        words.skip(1);  // the type of the laser
        scan.directions.first_rad = words.number();
        words.skip(1);  // the field of view
        scan.directions.increment_rad = words.number();
        const double max_range_m = words.number();
        words.skip(2);  // accuracy, and whether there are remissions
        return max_range_m;
    }

    /// Logs of before 2005 have no count of remissions, and the pose in its place; whether one of 0
    /// is a count, only the length of the line tells.
    static void read_remissions(WordLine& words, RecordedScan& scan) {
        constexpr std::size_t behind = 14;  // two poses, five figures, times and host
        WordLine ahead = words;
        const std::size_t count = ahead.count();
        if (ahead.wrong()) return;
        if (count == 0 && ahead.left() >= behind) words = ahead;
        if (count != scan.ranges.size()) return;
        auto remissions = ahead.numbers(count);
        if (ahead.wrong() || ahead.left() < 3) return;
        scan.intensities = std::move(remissions);
        words = ahead;
    }

    std::size_t stream_of(const std::string& message, double max_range_m) {
        const auto [found, is_new] = streams_by_message_.try_emplace(message, 0);
        if (!is_new) return found->second;
        RecordedStream stream{.name = message, .type = "CARMEN"};
        if (max_range_m > 0) stream.identity.max_range_m = max_range_m;
        return found->second = add_stream(std::move(stream));
    }

    std::map<std::string, std::size_t> streams_by_message_;
};

}  // namespace

bool is_carmen_line(std::string_view line) {
    line = trimmed(line);
    if (line.starts_with("# CARMEN")) return true;
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    return std::ranges::find(messages, kind_of(word)) != messages.end();
}

Expected<std::unique_ptr<Recording>> open_carmen(InputFile file) {
    return std::make_unique<Carmen>(std::move(file));
}

}  // namespace scipd::sim
