// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/words.h"

#include <algorithm>
#include <span>

#include "protocol/step_window.h"

namespace scipd::protocol {
namespace {

struct CommandWords {
    std::string_view code;
    std::string_view asks;
    std::string_view done;  ///< what the reply with 00 tells
};

/// All commands but those for scans, which are put together from their parameters.
constexpr CommandWords commands[] = {
    {"VV", "requests the version", "returns the version"},
    {"PP", "requests the parameters", "returns the parameters"},
    {"II", "requests the state", "returns the state"},
    {"%ST", "requests the state as a number", "returns the state as a number"},
    {"BM", "switches the laser on", "the laser is on"},
    {"QT", "ends the stream and switches the laser off", "the stream has ended, the laser is off"},
    {"%SL", "puts the scanner to sleep: laser off, motor stopped", "the scanner sleeps"},
    {"RS", "resets the scanner", "the scanner is reset"},
    {"RT", "resets the scanner but for its motor and its line", "the scanner is reset in part"},
    {"RB", "reboots the scanner, when it comes twice within a second", "the scanner reboots"},
    {"TM0", "enters time-adjust mode", "the scanner is in time-adjust mode"},
    {"TM1", "requests the time", "returns the time"},
    {"TM2", "leaves time-adjust mode", "the scanner has left time-adjust mode"},
    {"TM", "requests a step of time-adjust mode that does not exist", ""},
    {"%TM1", "requests the time in microseconds", "returns the time in microseconds"},
    {"%TM", "requests a step of time-adjust mode that does not exist", ""},
    {"SS", "sets the bit rate of the serial line", "the bit rate changes"},
    {"CR", "sets the speed of the motor", "the motor changes its speed"},
    {"HS", "sets the sensitivity", "the sensitivity is set"},
    {"DB", "simulates an error state", "the error state is simulated"},
    {"$IP", "sets network addresses", "the addresses are taken, and not kept"},
    {"SCIP2.0", "leaves SCIP 1.1", "SCIP 2.0 is spoken"},
};

struct StatusWords {
    std::string_view code;
    std::string_view words;
};

constexpr StatusWords of_all[] = {
    {"00", "carried out"},
    {"99", "a scan of the stream"},
    {"0A", "the scanner cannot make the data"},
    {"0B", "the buffers are full, or the command came again too soon"},
    {"0C", "the request is too short, or the firmware is older than the command"},
    {"0D", "the request is too long; of some firmwares, the command is unknown"},
    {"0E", "the scanner does not know the command, or is in time-adjust mode"},
    {"0F", "the scanner does not support the command; of some firmwares, parameters are missing"},
    {"0G", "the string behind the semicolon is longer than 16 characters"},
    {"0H", "the string behind the semicolon has characters that are not allowed"},
    {"0I", "the scanner waits for new firmware"},
    {"0L", "the scanner is out of order; RB twice reboots it"},
    {"0M", "the scanner is unstable, and leaves this scan out"},
    {"10", "not in the present state"},
    {"98", "the stream goes on"},
};
constexpr StatusWords of_scans[] = {
    {"01", "the first step is no number"},
    {"02", "the last step is no number"},
    {"03", "the cluster is no number"},
    {"04", "the scanner has no such step"},
    {"05", "the last step lies before the first"},
    {"06", "the interval is no number"},
    {"07", "the number of scans is no number"},
};
constexpr StatusWords of_one_scan[] = {
    {"10", "not in the present state; BM switches the laser on, which a single scan needs"},
};
constexpr StatusWords of_settings[] = {
    {"01", "the value is no number"},
    {"02", "the model does not have this value"},
    {"03", "this is the present value"},
    {"04", "the model has one value only"},
};
constexpr StatusWords of_sensitivity[] = {
    {"01", "it is neither on nor off"},
    {"02", "this is the present value"},
    {"03", "the model has one value only"},
};
constexpr StatusWords of_rehearsals[] = {
    {"01", "there is no such error to simulate"},   {"02", "an error is simulated already"},
    {"03", "there is no simulated error to end"},   {"04", "this model does not simulate that"},
    {"05", "the scanner is in a real error state"},
};
constexpr StatusWords of_laser[] = {
    {"01", "the laser is out of order"},
    {"02", "the laser is on already"},
};
constexpr StatusWords of_reboot[] = {
    {"01", "the scanner reboots when RB comes again within a second"},
};
constexpr StatusWords of_time[] = {
    {"01", "there is no such mode"},
    {"02", "the scanner is in time-adjust mode already"},
    {"03", "the scanner is not in time-adjust mode"},
    {"04", "the scanner returns the time only in time-adjust mode; TM0 enters it"},
};
constexpr StatusWords of_addresses[] = {
    {"01", "this is no address"},
};

/// What numbers mean to this command alone.
std::span<const StatusWords> own_words(const Command& command) {
    if (command.brings_one_scan() || command.brings_scans()) return of_scans;
    const std::string_view code = command.code;
    if (code == "SS" || code == "CR") return of_settings;
    if (code == "HS") return of_sensitivity;
    if (code == "DB") return of_rehearsals;
    if (code == "BM") return of_laser;
    if (code == "RB") return of_reboot;
    if (code == "$IP") return of_addresses;
    if (code.starts_with("TM") || code.starts_with("%TM")) return of_time;
    return {};
}

std::string_view find(std::span<const StatusWords> table, Status status) {
    const auto found = std::ranges::find(table, status.text(), &StatusWords::code);
    return found == table.end() ? std::string_view() : found->words;
}

/// SCIP 2.0 specification, page 11: the numbers of troubles.
std::string_view trouble_words(Status status) {
    const int number = parse_digits(status.text()).value_or(0);
    if (number >= 21 && number <= 49) return "the stream pauses to verify an error";
    if (number >= 50 && number <= 97) return "the laser or the motor is out of order";
    return {};
}

const CommandWords* find(const Command& command) {
    const auto* const found = std::ranges::find(commands, command.code, &CommandWords::code);
    return found == std::end(commands) ? nullptr : found;
}

/// "distances and intensities of every echo"
std::string contents_words(const DataFormat& format) {
    std::string text = "distances";
    if (format.width == 2) text += " of two characters";
    if (format.intensity) text += " and intensities";
    if (format.echoes) text += " of every echo";
    if (format.io_lines) text += ", with inputs and outputs";
    if (format.stamp == Stamp::microseconds) text += ", with stamps in microseconds";
    return text;
}

/// ", steps 44 to 725, one value for 3 steps"; nothing where the digits are none.
std::string window_words(std::string_view digits) {
    const auto first = parse_digits(digits.substr(0, 4));
    const auto last = parse_digits(digits.substr(4, 4));
    const auto cluster = parse_digits(digits.substr(8, 2));
    if (!first || !last) return {};
    std::string text = ", steps " + std::to_string(*first) + " to " + std::to_string(*last);
    if (cluster.value_or(0) > 1) text += ", one value for " + std::to_string(*cluster) + " steps";
    return text;
}

/// The digits of a request are as many as they should be.
bool is_complete(const Request& request) {
    return request.command != nullptr &&
           request.parameters_length == width(request.command->parameters);
}

/// How many scans are still to come; 0: endless.
int scans_left(const Request& request) {
    return parse_digits(request.parameters().substr(11, 2)).value_or(0);
}

std::string stream_words(const Request& request) {
    const int scans = scans_left(request);
    const int interval = parse_digits(request.parameters().substr(10, 1)).value_or(0);
    std::string text = scans == 0 ? "requests an endless stream of "
                                  : "requests " + std::to_string(scans) + " scans of ";
    text += contents_words(request.command->format) + window_words(request.parameters());
    if (interval > 0) text += ", passing over " + std::to_string(interval) + " turns each time";
    return text;
}

std::string scan_words(const Request& echo) {
    const std::string count(echo.parameters().substr(11, 2));
    return "a scan of the stream; echoed scan count: " + count +
           (count == "00" ? " (endless, or the last one)" : "");
}

using Kind = Scip1Request::Kind;

std::string scan_words(const StepWindow& window) {
    std::string text = "requests one scan, steps " + std::to_string(window.first) + " to " +
                       std::to_string(window.last);
    if (window.cluster > 1) text += ", one value for " + std::to_string(window.cluster) + " steps";
    return text;
}

}  // namespace

std::string request_words(const Request& request) {
    if (request.command == nullptr) return "no command that this scanner knows";
    const Command& command = *request.command;
    if (const CommandWords* const words = find(command)) return std::string(words->asks);
    if (!is_complete(request)) return "requests " + contents_words(command.format);
    if (command.brings_scans()) return stream_words(request);
    return "requests one scan of " + contents_words(command.format) +
           window_words(request.parameters());
}

std::string reply_words(const Request& echo, Status status) {
    if (status == status::scan_follows && is_complete(echo) && echo.command->brings_scans())
        return scan_words(echo);
    if (status != status::ok || echo.command == nullptr) return "not carried out";
    if (echo.command->brings_scans()) return "the stream begins";
    if (echo.command->brings_one_scan()) return "the requested scan";
    const CommandWords* const words = find(*echo.command);
    return std::string(words != nullptr ? words->done : "carried out");
}

std::string_view status_words(const Command* command, Status status) {
    if (command != nullptr) {
        if (command->brings_one_scan() && status == status::denied) return of_one_scan[0].words;
        if (const auto words = find(own_words(*command), status); !words.empty()) return words;
    }
    const auto words = find(of_all, status);
    return words.empty() ? trouble_words(status) : words;
}

std::string scip1_request_words(const Scip1Request& request) {
    switch (request.kind) {
        case Kind::version:
            return "requests the version, in SCIP 1.1";
        case Kind::scan:
            return scan_words(request.window) + ", in SCIP 1.1";
        case Kind::laser_off:
            return "switches the laser off, in SCIP 1.1";
        case Kind::laser_on:
            return "switches the laser on, in SCIP 1.1";
        case Kind::bit_rate:
            return "sets the bit rate to " + std::to_string(request.bit_rate) + ", in SCIP 1.1";
        case Kind::choose_scip2:
            return "leaves SCIP 1.1";
        case Kind::unknown:
            break;
    }
    return {};
}

std::string_view scip1_reply_words(const Scip1Request& echo, char status) {
    if (status != scip1_status::ok) return "not carried out";
    switch (echo.kind) {
        case Kind::version:
            return "returns the version";
        case Kind::scan:
            return "the requested scan";
        case Kind::laser_off:
            return "the laser is off";
        case Kind::laser_on:
            return "the laser is on";
        case Kind::bit_rate:
            return "the bit rate changes";
        case Kind::choose_scip2:
            return "SCIP 2.0 is spoken";
        case Kind::unknown:
            break;
    }
    return "carried out";
}

std::string_view scip1_status_words(char status) {
    if (status == scip1_status::ok) return "carried out";
    if (status == scip1_status::unknown)
        return "the scanner does not know the request, or its laser is off";
    return {};
}

}  // namespace scipd::protocol
