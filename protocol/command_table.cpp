// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/command_table.h"

namespace scipd::protocol {
namespace {

using enum Parameters;
using enum Operation;

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
constexpr std::nullptr_t unknown = nullptr;

// Standby, measuring and streaming: recordings of a URG-04LX, a UTM-30LX and a UST-10LX, and
// SCIP 2.0 specification C-42-03320B. Time adjust: families A refuse everything but TM with 0E,
// which urg_library and UrgBenri take as the sign of that mode; the UTM-30LX-EW leaves it by QT
// (urg_stamped), the UST answers 10. Where sources differ: TM1 outside adjust mode is 04 by the
// specification and 00 on real Ethernet models; a repeated TM0 is 02, on the UTM-30LX-EW 00.
// Booting: urg_stamped's simulator; only family B answers then. Error: hokuyolx, which paraphrases
// the Ethernet protocol, for B and C (0L to all but RB and questions); the specification's "50 to
// 97: hardware trouble" for families A, which cannot sleep. Asleep: QT and BM wake (urg_library,
// hokuyolx); that the rest is refused or answered as here is deduced from standby. GS and MS of
// families A2: programs made for a UTM-30LX ask for them, one waits for the 2278 bytes that 1081
// points of two characters make.
//
// The columns of a gate: standby, measuring, streaming, adjust, booting, error, asleep.
// clang-format off
constexpr Command table[] = {
    //                                                 A1                      A2                      B                       C
    {"VV",      none,   report_version,      no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
    {"PP",      none,   report_parameters,   no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- 10 -- -- --", "-- -- -- 10 -- -- --"}},
    {"II",      none,   report_state,        no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
    {"%ST",     none,   report_state_number, no_data,    {unknown,                unknown,                "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
    {"BM",      none,   switch_laser_on,     no_data,    {"-- 02 02 0E -- 01 --", "-- 02 02 0E -- 01 --", "-- 02 02 10 10 0L --", "-- 02 02 10 10 0L --"}},
    {"QT",      none,   quit,                no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- -- -- 0L --", "-- -- -- 10 -- 0L --"}},
    {"%SL",     none,   sleep,               no_data,    {unknown,                unknown,                "-- -- 10 10 10 0L 10", "-- -- 10 10 10 0L 10"}},
    {"RS",      none,   reset,               no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- -- -- 0L --", "-- -- -- -- -- 0L --"}},
    {"RT",      none,   partial_reset,       no_data,    {unknown,                unknown,                "-- -- -- -- -- 0L --", "-- -- -- -- -- 0L --"}},
    {"RB",      none,   reboot,              no_data,    {unknown,                unknown,                "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
    {"GD",      window, single_shot,         three_char, {"10 -- -- 0E -- 50 --", "10 -- -- 0E -- 50 --", "10 -- 10 10 10 0L 10", "10 -- 10 10 10 0L 10"}},
    {"GS",      window, single_shot,         two_char,   {"10 -- -- 0E -- 50 --", "10 -- -- 0E -- 50 --", unknown,                unknown}},
    {"GE",      window, single_shot,         intensity,  {unknown,                "10 -- -- 0E -- 50 --", "10 -- 10 10 10 0L 10", "10 -- 10 10 10 0L 10"}},
    {"MD",      scans,  stream,              three_char, {"-- -- -- 0E -- 50 --", "-- -- -- 0E -- 50 --", "-- -- -- 10 10 0L 10", "-- -- -- 10 10 0L 10"}},
    {"MS",      scans,  stream,              two_char,   {"-- -- -- 0E -- 50 --", "-- -- -- 0E -- 50 --", unknown,                unknown}},
    {"ME",      scans,  stream,              intensity,  {unknown,                "-- -- -- 0E -- 50 --", "-- -- -- 10 10 0L 10", "-- -- -- 10 10 0L 10"}},
    {"HD",      window, single_shot,         echoes,     {unknown,                "10 -- -- 0E -- 50 --", "10 -- 10 10 10 0L 10", unknown}, Feature::multi_echo},
    {"HE",      window, single_shot,         both,       {unknown,                "10 -- -- 0E -- 50 --", "10 -- 10 10 10 0L 10", unknown}, Feature::multi_echo},
    {"ND",      scans,  stream,              echoes,     {unknown,                "-- -- -- 0E -- 50 --", "-- -- -- 10 10 0L 10", unknown}, Feature::multi_echo},
    {"NE",      scans,  stream,              both,       {unknown,                "-- -- -- 0E -- 50 --", "-- -- -- 10 10 0L 10", unknown}, Feature::multi_echo},
    {"TM0",     none,   enter_adjust,        no_data,    {"-- -- -- 02 -- 50 --", "-- -- -- 02 -- 50 --", "-- -- 10 -- 10 0L 10", "-- -- 10 02 10 0L 10"}},
    {"TM1",     none,   report_time,         no_data,    {"04 04 04 -- -- 04 --", "04 04 04 -- -- 04 --", "-- -- -- -- -- 0L --", "-- -- -- -- -- 0L --"}},
    {"TM2",     none,   leave_adjust,        no_data,    {"03 03 03 -- -- 03 --", "03 03 03 -- -- 03 --", "03 10 10 -- 10 0L 10", "03 10 10 -- 10 0L 10"}},
    {"TM",      digit,  refuse_digit,        no_data,    {"-- -- -- -- -- -- --", "-- -- -- -- -- -- --", "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
    // Newest firmware: urg_stamped's simulator, where %TM enters no mode; inputs and outputs: urg_library.
    {"%MD",     scans,  stream,              us_distance, {unknown, unknown, unknown, "-- -- -- 10 10 0L 10"}, Feature::microseconds},
    {"%ME",     scans,  stream,              us_both,    {unknown, unknown, unknown, "-- -- -- 10 10 0L 10"}, Feature::microseconds},
    {"%TM1",    none,   report_time,         us_time,    {unknown, unknown, unknown, "-- -- -- -- -- 0L --"}, Feature::microseconds},
    {"%TM",     digit,  refuse_digit,        no_data,    {unknown, unknown, unknown, "-- -- -- -- -- -- --"}, Feature::microseconds},
    {"GF",      window, single_shot,         io_distance, {unknown, unknown, unknown, "10 -- 10 10 10 0L 10"}, Feature::io_lines},
    {"GG",      window, single_shot,         io_both,    {unknown, unknown, unknown, "10 -- 10 10 10 0L 10"}, Feature::io_lines},
    {"MF",      scans,  stream,              io_distance, {unknown, unknown, unknown, "-- -- -- 10 10 0L 10"}, Feature::io_lines},
    {"MG",      scans,  stream,              io_both,    {unknown, unknown, unknown, "-- -- -- 10 10 0L 10"}, Feature::io_lines},
    // What can be set. On Ethernet SS is 0F (the rate of urg_library's dummy serial line), CR and HS are unknown.
    {"SS",      rate,   set_bit_rate,        no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "0F 0F 0F 0F 0F 0F 0F", "0F 0F 0F 0F 0F 0F 0F"}},
    {"CR",      number, set_motor_level,     no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", unknown,                unknown}},
    {"HS",      digit,  set_sensitivity,     no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", unknown,                unknown}},
    {"DB",      number, rehearse,            no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", unknown,                unknown}},
    {"$IP",     addresses, set_address,      no_data,    {unknown,                unknown,                "-- -- 10 10 10 0L 10", "-- -- 10 10 10 0L 10"}},
    {"SCIP2.0", none,   choose_scip2,        no_data,    {"-- -- -- 0E -- -- --", "-- -- -- 0E -- -- --", "-- -- -- -- -- -- --", "-- -- -- -- -- -- --"}},
};
// clang-format on

}  // namespace

std::span<const Command> command_table() {
    return table;
}

std::optional<Status> refusal(const Command& command, State state, const DeviceProfile& profile) {
    for (const Answer& answer : profile.answers) {
        if (answer.command == command.code && answer.state == state) return answer.status;
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

}  // namespace scipd::protocol
