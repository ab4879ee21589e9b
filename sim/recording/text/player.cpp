// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/player.h"

#include <map>
#include <set>
#include <string>
#include <utility>

#include "sim/recording/text/text_recording.h"
#include "sim/recording/text/text_values.h"
#include "sim/recording/text/word_line.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

// Player's numbers of these messages.
constexpr double data = 1;
constexpr double scan_alone = 1;
constexpr double scan_with_pose = 2;

class Player final : public TextRecording {
  public:
    explicit Player(InputFile file) : TextRecording("player", std::move(file)) {}

  private:
    /// A line has time, host, robot, interface, index, type and subtype, then what they ask for.
    Next take(std::string_view line) override {
        line = trimmed(line);
        if (line.empty() || line.front() == '#') return std::nullopt;
        WordLine words(line);
        const auto time = host_time_in(words.word());
        words.skip(2);
        const std::string interface(words.word());
        const std::string index(words.word());
        const double type = words.number();
        const double subtype = words.number();
        if (!time || words.wrong())
            return refuse(
                "a line must begin with time, host, robot, interface, index, type, "
                "subtype, as those of file version 0.2 and 0.3 do");
        if (interface != "laser") return leave_out(interface);
        if (type != data || (subtype != scan_alone && subtype != scan_with_pose))
            return std::nullopt;
        return take_scan(words, index, *time, subtype == scan_with_pose);
    }

    Next take_scan(WordLine& words, const std::string& index, HostTime time, bool with_pose) {
        RecordedScan scan{.host_time = time, .unit = RangeUnit::metres};
        words.skip(1);  // the number of the scan
        if (with_pose) {
            scan.pose = pose_in(words);
            words.skip(3);
        }
        scan.directions.first_rad = words.number();
        words.skip(1);  // the last angle
        scan.directions.increment_rad = words.number();
        const double max_range_m = words.number();
        const std::size_t count = words.count();
        for (std::size_t i = 0; i < count; ++i) {
            scan.ranges.push_back(words.number());
            scan.intensities.push_back(words.number());
        }
        if (words.wrong() || words.left() > 0)
            return refuse("must have a range and an intensity for each reading that it announces");
        return RecordedItem{stream_of(index, max_range_m), std::move(scan)};
    }

    Next leave_out(const std::string& interface) {
        if (left_out_.insert(interface).second)
            warn(lines().name() + ": what " + quote(interface) + " says is left out");
        return std::nullopt;
    }

    std::size_t stream_of(const std::string& index, double max_range_m) {
        const auto [found, is_new] = streams_by_index_.try_emplace(index, 0);
        if (!is_new) return found->second;
        RecordedStream stream{.name = "laser:" + index, .type = "Player laser"};
        if (max_range_m > 0) stream.identity.max_range_m = max_range_m;
        return found->second = add_stream(std::move(stream));
    }

    std::map<std::string, std::size_t> streams_by_index_;
    std::set<std::string> left_out_;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_player(InputFile file) {
    return std::make_unique<Player>(std::move(file));
}

}  // namespace scipd::sim
