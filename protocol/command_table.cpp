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
constexpr std::nullptr_t unknown = nullptr;

// Standby, measuring and streaming: recordings of a URG-04LX, a UTM-30LX and a UST-10LX, and
// SCIP 2.0 specification C-42-03320B. Time adjust: families A refuse everything but TM with 0E,
// which urg_library and UrgBenri take as the sign of that mode; the UTM-30LX-EW leaves it by QT
// (urg_stamped), the UST answers 10. Where sources differ: TM1 outside adjust mode is 04 by the
// specification and 00 on real Ethernet models; a repeated TM0 is 02, on the UTM-30LX-EW 00.
//
// The columns of a gate: standby, measuring, streaming, adjust.
// clang-format off
constexpr Command table[] = {
    //                                               A1             A2             B              C
    {"VV",  none,   report_version,    no_data,    {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- --", "-- -- -- --"}},
    {"PP",  none,   report_parameters, no_data,    {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- 10", "-- -- -- 10"}},
    {"II",  none,   report_state,      no_data,    {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- --", "-- -- -- --"}},
    {"BM",  none,   switch_laser_on,   no_data,    {"-- 02 02 0E", "-- 02 02 0E", "-- 02 02 10", "-- 02 02 10"}},
    {"QT",  none,   quit,              no_data,    {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- --", "-- -- -- 10"}},
    {"RS",  none,   reset,             no_data,    {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- --", "-- -- -- --"}},
    {"RT",  none,   reset,             no_data,    {unknown,       unknown,       "-- -- -- --", "-- -- -- --"}},
    {"GD",  window, single_shot,       three_char, {"10 -- -- 0E", "10 -- -- 0E", "10 -- 10 10", "10 -- 10 10"}},
    {"GS",  window, single_shot,       two_char,   {"10 -- -- 0E", unknown,       unknown,       unknown}},
    {"GE",  window, single_shot,       intensity,  {unknown,       "10 -- -- 0E", "10 -- 10 10", "10 -- 10 10"}},
    {"MD",  scans,  stream,            three_char, {"-- -- -- 0E", "-- -- -- 0E", "-- -- -- 10", "-- -- -- 10"}},
    {"MS",  scans,  stream,            two_char,   {"-- -- -- 0E", unknown,       unknown,       unknown}},
    {"ME",  scans,  stream,            intensity,  {unknown,       "-- -- -- 0E", "-- -- -- 10", "-- -- -- 10"}},
    {"TM0", none,   enter_adjust,      no_data,    {"-- -- -- 02", "-- -- -- 02", "-- -- 10 --", "-- -- 10 02"}},
    {"TM1", none,   report_time,       no_data,    {"04 04 04 --", "04 04 04 --", "-- -- -- --", "-- -- -- --"}},
    {"TM2", none,   leave_adjust,      no_data,    {"03 03 03 --", "03 03 03 --", "03 10 10 --", "03 10 10 --"}},
    {"TM",  digit,  refuse_digit,      no_data,    {"-- -- -- --", "-- -- -- --", "-- -- -- --", "-- -- -- --"}},
};
// clang-format on

}  // namespace

std::span<const Command> command_table() {
    return table;
}

const Command* find_command(std::string_view line, Family family) {
    const Command* found = nullptr;
    for (const Command& command : table) {
        const bool longer = found == nullptr || command.code.size() > found->code.size();
        if (longer && line.starts_with(command.code) && command.gate(family).known())
            found = &command;
    }
    return found;
}

}  // namespace scipd::protocol
