// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/command_table.h"

#include <algorithm>

#include "protocol/handlers.h"

namespace scipd::protocol {
namespace {

using namespace handlers;
using enum Parameters;
using enum Feature;

constexpr DataFormat no_data{.width = 0};
constexpr DataFormat two_char{.width = 2};
constexpr DataFormat three_char{.width = 3};
constexpr DataFormat intensity{.width = 3, .intensity = true};
constexpr DataFormat echoes{.width = 3, .echoes = true};
constexpr DataFormat both{.width = 3, .intensity = true, .echoes = true};
constexpr DataFormat io_distance{.width = 3, .io_lines = true};
constexpr DataFormat io_both{.width = 3, .intensity = true, .io_lines = true};
constexpr DataFormat us_time{.width = 0, .stamp = Stamp::microseconds};
constexpr DataFormat us_distance{.width = 3, .stamp = Stamp::microseconds};
constexpr DataFormat us_both{.width = 3, .intensity = true, .stamp = Stamp::microseconds};

// Where the statuses are known from, by state. The old families are urg and utm_usb.
//
// standby, measuring, streaming: recordings of a URG-04LX, a UTM-30LX and a UST-10LX, and the SCIP
//   2.0 specification C-42-03320B.
// adjust: the old families refuse everything but TM with 0E, which urg_library and UrgBenri take as
//   the sign of that mode. The UTM-30LX-EW leaves it by QT (urg_stamped), the UST answers 10.
// booting: urg_stamped's simulator. Only ethernet_multi_echo answers then.
// error: hokuyolx, which paraphrases the Ethernet protocol, for Ethernet models (0L to all but RB
//   and questions). The specification's "50 to 97: hardware trouble" for the old families.
// asleep: QT and BM wake (urg_library, hokuyolx). That the rest is refused or answered as here is
//   deduced from standby. The old families cannot sleep.
//
// Where sources differ: TM1 outside adjust mode is 04 by the specification and 00 on real Ethernet
// models. A repeated TM0 is 02, on the UTM-30LX-EW 00. GS and MS of utm_usb: programs made for a
// UTM-30LX ask for them, and one waits for the 2278 bytes that 1081 points of two characters make.
//
// A cell has a status for each state, or -- where the command is carried out. The states are, from
// left to right: standby, measuring, streaming, adjust, booting, error, asleep. A family whose cell
// is empty does not know the command.
// clang-format off
constexpr Command table[] = {
    // code, parameters, handler, data, which models of the family have it
    // urg                | utm_usb              | ethernet_multi_echo  | ust
    // What the scanner says of itself.
    {"VV", none, report_version, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
    {"PP", none, report_parameters, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- 10 -- -- -- | -- -- -- 10 -- -- --"},
    {"II", none, report_state, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
    {"%ST", none, report_state_number, no_data, common,
     "                     |                      | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
    // Laser, motor and power.
    {"BM", none, switch_laser_on, no_data, common,
     "-- 02 02 0E -- 01 -- | -- 02 02 0E -- 01 -- | -- 02 02 10 10 0L -- | -- 02 02 10 10 0L --"},
    {"QT", none, quit, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- -- -- 0L -- | -- -- -- 10 -- 0L --"},
    {"%SL", none, sleep, no_data, common,
     "                     |                      | -- -- 10 10 10 0L 10 | -- -- 10 10 10 0L 10"},
    {"RS", none, reset, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- -- -- 0L -- | -- -- -- -- -- 0L --"},
    {"RT", none, partial_reset, no_data, common,
     "                     |                      | -- -- -- -- -- 0L -- | -- -- -- -- -- 0L --"},
    {"RB", none, reboot, no_data, common,
     "                     |                      | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
    // One scan.
    {"GD", window, begin_single_scan, three_char, common,
     "10 -- -- 0E -- 50 -- | 10 -- -- 0E -- 50 -- | 10 -- 10 10 10 0L 10 | 10 -- 10 10 10 0L 10"},
    {"GS", window, begin_single_scan, two_char, common,
     "10 -- -- 0E -- 50 -- | 10 -- -- 0E -- 50 -- |                      |                     "},
    {"GE", window, begin_single_scan, intensity, common,
     "                     | 10 -- -- 0E -- 50 -- | 10 -- 10 10 10 0L 10 | 10 -- 10 10 10 0L 10"},
    // Scan after scan.
    {"MD", scans, begin_stream, three_char, common,
     "-- -- -- 0E -- 50 -- | -- -- -- 0E -- 50 -- | -- -- -- 10 10 0L 10 | -- -- -- 10 10 0L 10"},
    {"MS", scans, begin_stream, two_char, common,
     "-- -- -- 0E -- 50 -- | -- -- -- 0E -- 50 -- |                      |                     "},
    {"ME", scans, begin_stream, intensity, common,
     "                     | -- -- -- 0E -- 50 -- | -- -- -- 10 10 0L 10 | -- -- -- 10 10 0L 10"},
    // Every echo of a step.
    {"HD", window, begin_single_scan, echoes, multi_echo,
     "                     | 10 -- -- 0E -- 50 -- | 10 -- 10 10 10 0L 10 |                     "},
    {"HE", window, begin_single_scan, both, multi_echo,
     "                     | 10 -- -- 0E -- 50 -- | 10 -- 10 10 10 0L 10 |                     "},
    {"ND", scans, begin_stream, echoes, multi_echo,
     "                     | -- -- -- 0E -- 50 -- | -- -- -- 10 10 0L 10 |                     "},
    {"NE", scans, begin_stream, both, multi_echo,
     "                     | -- -- -- 0E -- 50 -- | -- -- -- 10 10 0L 10 |                     "},
    // The clock.
    {"TM0", none, enter_adjust, no_data, common,
     "-- -- -- 02 -- 50 -- | -- -- -- 02 -- 50 -- | -- -- 10 -- 10 0L 10 | -- -- 10 02 10 0L 10"},
    {"TM1", none, report_time, no_data, common,
     "04 04 04 -- -- 04 -- | 04 04 04 -- -- 04 -- | -- -- -- -- -- 0L -- | -- -- -- -- -- 0L --"},
    {"TM2", none, leave_adjust, no_data, common,
     "03 03 03 -- -- 03 -- | 03 03 03 -- -- 03 -- | 03 10 10 -- 10 0L 10 | 03 10 10 -- 10 0L 10"},
    {"TM", digit, refuse_digit, no_data, common,
     "-- -- -- -- -- -- -- | -- -- -- -- -- -- -- | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
    // The newest firmware, as urg_stamped's simulator has it: %TM enters no mode.
    {"%MD", scans, begin_stream, us_distance, microseconds,
     "                     |                      |                      | -- -- -- 10 10 0L 10"},
    {"%ME", scans, begin_stream, us_both, microseconds,
     "                     |                      |                      | -- -- -- 10 10 0L 10"},
    {"%TM1", none, report_time, us_time, microseconds,
     "                     |                      |                      | -- -- -- -- -- 0L --"},
    {"%TM", digit, refuse_digit, no_data, microseconds,
     "                     |                      |                      | -- -- -- -- -- -- --"},
    // With inputs and outputs: urg_library.
    {"GF", window, begin_single_scan, io_distance, io_lines,
     "                     |                      |                      | 10 -- 10 10 10 0L 10"},
    {"GG", window, begin_single_scan, io_both, io_lines,
     "                     |                      |                      | 10 -- 10 10 10 0L 10"},
    {"MF", scans, begin_stream, io_distance, io_lines,
     "                     |                      |                      | -- -- -- 10 10 0L 10"},
    {"MG", scans, begin_stream, io_both, io_lines,
     "                     |                      |                      | -- -- -- 10 10 0L 10"},
    // What can be set. On Ethernet SS is 0F, for the rate of urg_library's dummy serial line, and
    // CR and HS are unknown.
    {"SS", rate, set_bit_rate, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | 0F 0F 0F 0F 0F 0F 0F | 0F 0F 0F 0F 0F 0F 0F"},
    {"CR", number, set_motor_level, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- |                      |                     "},
    {"HS", digit, set_sensitivity, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- |                      |                     "},
    {"DB", number, rehearse, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- |                      |                     "},
    {"$IP", addresses, set_address, no_data, common,
     "                     |                      | -- -- 10 10 10 0L 10 | -- -- 10 10 10 0L 10"},
    {"SCIP2.0", none, choose_scip2, no_data, common,
     "-- -- -- 0E -- -- -- | -- -- -- 0E -- -- -- | -- -- -- -- -- -- -- | -- -- -- -- -- -- --"},
};
// clang-format on

}  // namespace

std::span<const Command> command_table() {
    return table;
}

std::optional<Status> refusal(const Command& command, State state, const DeviceProfile& profile) {
    for (const Deviation& deviation : profile.deviations) {
        if (deviation.command == command.code && deviation.state == state) return deviation.status;
    }
    return command.gate(profile.family).refusal(state);
}

const Command* find_command(std::string_view line, const DeviceProfile& profile) {
    const Command* found = nullptr;
    for (const Command& command : table) {
        const bool longer = found == nullptr || command.code.size() > found->code.size();
        if (longer && line.starts_with(command.code) && command.gate(profile.family).known() &&
            profile.has(command.needs))
            found = &command;
    }
    return found;
}

std::optional<Deviation> parse_deviation(std::string_view text) {
    const std::size_t first = text.find(' ');
    const std::size_t last = text.rfind(' ');
    if (first == last) return std::nullopt;
    const std::string_view code = text.substr(0, first);
    const std::string_view state = text.substr(first + 1, last - first - 1);
    const std::string_view status = text.substr(last + 1);
    const auto named = std::ranges::find(state_names, state);
    const bool known = std::ranges::find(table, code, &Command::code) != std::end(table);
    const auto parsed = Status::parse(status);
    if (!known || named == state_names.end() || (!parsed && status != "--")) return std::nullopt;
    return Deviation{std::string(code), static_cast<State>(named - state_names.begin()), parsed};
}

}  // namespace scipd::protocol
