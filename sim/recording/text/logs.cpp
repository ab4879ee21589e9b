// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Logs of robots: a message in each line, ranges in metres.
#include <algorithm>
#include <array>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "sim/recording/text/table_row.h"
#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

/// Remissions follow the ranges, with their number in front; then come the poses of the laser and
/// the robot. In pairs, an intensity follows each range.
struct Extras {
    bool remissions = false;
    bool poses = false;
    bool pairs = false;
};

/// A message with the scan of a laser: the columns of its line.
struct LaserMessage {
    table::Columns columns;
    table::Column max_range_m;
    std::size_t count = 0;  ///< number of ranges, which begin in the next column
    Extras extras;
    std::string_view name = {};  ///< in logs of CARMEN
};

constexpr table::Columns carmen_columns = {.host_time = -3, .first_rad = 2, .increment_rad = 4};
constexpr std::array carmen_messages = {
    LaserMessage{{.host_time = -3}, {}, 1, {.poses = true}, "FLASER"},
    LaserMessage{{.host_time = -3}, {}, 1, {.poses = true}, "RLASER"},
    LaserMessage{carmen_columns, 5, 8, {.remissions = true}, "RAWLASER"},
    LaserMessage{carmen_columns, 5, 8, {.remissions = true, .poses = true}, "ROBOTLASER"}};
/// The time of the message, the host, and the time since the log began.
constexpr std::size_t end_of_carmen_line = 3;

/// Data of Player's interface laser, subtypes 1 and 2.
constexpr LaserMessage player_scan = {
    {.host_time = 0, .first_rad = 8, .increment_rad = 10}, 11, 12, {.pairs = true}};
constexpr LaserMessage player_scan_with_pose = {
    {.host_time = 0, .first_rad = 11, .increment_rad = 13, .pose = 8}, 14, 15, {.pairs = true}};

/// Returns nullopt if the cell is no count of cells behind it.
std::optional<std::size_t> count_at(const table::Cells& cells, std::size_t index) {
    const auto count = table::finite_at(cells, 0, index);
    if (!count || !(*count >= 0 && *count <= static_cast<double>(cells.size() - index - 1)))
        return std::nullopt;
    return static_cast<std::size_t>(*count);
}

/// Adds the remissions that begin at `index`, and returns the index behind them. Logs of before
/// 2005 have the pose in place of their number; the length of the line shows which of both a 0 is.
std::size_t add_remissions(const table::Cells& cells, std::size_t index,
                           std::vector<table::Block>& blocks) {
    constexpr std::size_t fewest_behind = 14;  // two poses, five figures, times and host
    const std::size_t steps = blocks.front().steps;
    const auto count = count_at(cells, index);
    if (!count) return index;
    const std::size_t begin = index + 1;
    const std::size_t left = cells.size() - begin;
    if (*count == 0 && left >= fewest_behind) return begin;
    if (*count != steps || left < steps + end_of_carmen_line) return index;
    blocks.push_back({begin, steps, 1, true});
    return begin + steps;
}

/// FLASER and RLASER have no angles: their lasers see half a revolution, from right to left. 181
/// and 361 values include both ends, 180 and 360 the right end alone.
Directions half_turn(std::size_t values) {
    const auto count = static_cast<double>(std::max<std::size_t>(values, 2));
    const double gaps = values % 2 == 1 ? count - 1 : count;
    return {.first_rad = -std::numbers::pi / 2, .increment_rad = std::numbers::pi / gaps};
}

/// A log whose streams are lasers.
class LaserLog : public TextRecording {
  protected:
    using TextRecording::TextRecording;

    /// `why`: the error of a line that lacks numbers that it announces, or its time.
    Next take_scan(const table::Cells& cells, const LaserMessage& message, RecordedStream laser,
                   const std::string& why) {
        const auto& [remissions, poses, pairs] = message.extras;
        const std::size_t first = message.count + 1;
        const std::size_t stride = pairs ? 2 : 1;
        const std::size_t steps = count_at(cells, message.count).value_or(cells.size());
        std::size_t behind = first + steps * stride;
        const std::size_t fewest = behind + (pairs ? 0 : end_of_carmen_line);
        if (cells.size() < fewest || (pairs && cells.size() > fewest)) return refuse(why);
        table::Description description{.columns = message.columns,
                                       .blocks = {{first, steps, stride}},
                                       .blank = {.unit = RangeUnit::metres}};
        if (pairs) description.blocks.push_back({first + 1, steps, stride, true});
        if (remissions) behind = add_remissions(cells, behind, description.blocks);
        if (poses && cells.size() >= behind + 3 + end_of_carmen_line)
            description.columns.pose = static_cast<int>(behind);
        if (!message.columns.first_rad) description.blank.directions = half_turn(steps);
        auto scan = table::scan_of(cells, description);
        if (!scan || !scan->host_time || !scan->directions.first_rad ||
            !scan->directions.increment_rad)
            return refuse(why);
        const auto range_m = table::finite_at(cells, message.max_range_m);
        if (range_m && *range_m > 0) laser.identity.max_range_m = range_m;
        return RecordedItem{stream_of(laser.name, laser), *std::move(scan)};
    }
};

/// The first word of a line of CARMEN, such as RAWLASER2, and that without its number.
std::string_view carmen_name(std::string_view line) {
    line = trimmed(line);
    return line.substr(0, line.find_first_of(" \t"));
}
std::string_view carmen_kind(std::string_view name) {
    const bool numbered = name.starts_with("RAWLASER") || name.starts_with("ROBOTLASER");
    const bool has_number = numbered && name.back() >= '1' && name.back() <= '9';
    return has_number ? name.substr(0, name.size() - 1) : name;
}

class Carmen final : public LaserLog {
  public:
    explicit Carmen(InputFile file) : LaserLog("carmen", std::move(file)) {}

  private:
    Next take(std::string_view line) override {
        const std::string name(carmen_name(line));
        for (const LaserMessage& message : carmen_messages) {
            if (message.name == carmen_kind(name))
                return take_scan(table::cells_of(line, ' '), message,
                                 {.name = name, .type = "CARMEN"},
                                 name + " must have as many numbers as it says, and end in a time");
        }
        return std::nullopt;
    }
};

class Player final : public LaserLog {
  public:
    explicit Player(InputFile file) : LaserLog("player", std::move(file)) {}

  private:
    /// A line has time, host, robot, interface, index, type, subtype, and a message of these.
    Next take(std::string_view line) override {
        if (table::is_no_row(line)) return std::nullopt;
        const table::Cells cells = table::cells_of(line, ' ');
        const auto type = table::finite_at(cells, 5);
        const auto subtype = table::finite_at(cells, 6);
        if (!table::finite_at(cells, 0) || !type || !subtype)
            return refuse(
                "a line must begin with time, host, robot, interface, index, type, "
                "subtype, as those of file version 0.2 and 0.3 do");
        if (cells[3] != "laser") return leave_out(std::string(cells[3]));
        if (*type != 1 || (*subtype != 1 && *subtype != 2)) return std::nullopt;
        return take_scan(cells, *subtype == 1 ? player_scan : player_scan_with_pose,
                         {.name = "laser:" + std::string(cells[4]), .type = "Player laser"},
                         "must have a range and an intensity for each reading that it announces");
    }

    Next leave_out(const std::string& interface) {
        if (left_out_.insert(interface).second)
            warn(file_name() + ": what " + quote(interface) + " says is left out");
        return std::nullopt;
    }

    std::set<std::string> left_out_;
};

}  // namespace

bool is_carmen_line(std::string_view line) {
    constexpr std::array kinds = {"PARAM",    "SYNC",       "ODOM",    "TRUEPOS",
                                  "FLASER",   "RLASER",     "LASER3",  "LASER4",
                                  "RAWLASER", "ROBOTLASER", "NMEAGGA", "NMEARMC"};
    return trimmed(line).starts_with("# CARMEN") ||
           std::ranges::count(kinds, carmen_kind(carmen_name(line))) > 0;
}

Expected<std::unique_ptr<Recording>> open_carmen(InputFile file) {
    return std::make_unique<Carmen>(std::move(file));
}

Expected<std::unique_ptr<Recording>> open_player(InputFile file) {
    return std::make_unique<Player>(std::move(file));
}

}  // namespace scipd::sim
