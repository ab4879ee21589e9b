// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Meanings: SCIP 2.0 specification C-42-03320B, pages 10 to 23.
#include "protocol/client/status_text.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "protocol/client/scan_request.h"
#include "protocol/step_window.h"

namespace scipd::protocol::client {
namespace {

using Meaning = std::pair<std::string_view, std::string_view>;

constexpr std::array general{
    Meaning{"0A", "the scanner cannot make the data"},
    Meaning{"0B", "the scanner is out of buffers, or the request came again too soon"},
    Meaning{"0C", "the request is too short"},
    Meaning{"0D", "the request is too long"},
    Meaning{"0E", "the scanner does not know the command, or not in its present state"},
    Meaning{"0F", "the scanner does not support the command"},
    Meaning{"0G", "the string after the semicolon is too long"},
    Meaning{"0H", "the string after the semicolon has characters that are not allowed"},
    Meaning{"0I", "the scanner waits for new firmware"},
    Meaning{"0L", "the scanner is out of order; switch its power off and on"},
    Meaning{"0M", "the scanner is unstable for the moment"},
    Meaning{"10", "not in the scanner's present state (is the laser off?)"},
};

constexpr std::array of_scans{
    Meaning{"01", "the start step is no number"},
    Meaning{"02", "the end step is no number"},
    Meaning{"03", "the cluster is no number"},
    Meaning{"04", "the scanner does not have one of the steps"},
    Meaning{"05", "the end step lies before the start step"},
    Meaning{"06", "the interval is no number"},
    Meaning{"07", "the number of scans is no number"},
};

template <std::size_t count>
std::string_view find(const std::array<Meaning, count>& meanings, std::string_view status) {
    const auto* const found = std::ranges::find(meanings, status, &Meaning::first);
    return found == meanings.end() ? std::string_view{} : found->second;
}

std::string_view meaning_of(const Message& message) {
    if (const auto text = find(general, message.status); !text.empty()) return text;
    if (!parse_scan_echo(message.echo)) return {};
    const int number = parse_digits(message.status).value_or(0);
    if (number >= 21 && number <= 49) return "the scanner has stopped to look into an error";
    if (number >= 50 && number <= 97) return "the laser or the motor is out of order";
    return find(of_scans, message.status);
}

}  // namespace

std::string describe_status(const Message& message) {
    const std::string_view meaning = meaning_of(message);
    std::string text = "status " + message.status;
    if (!meaning.empty()) text.append(": ").append(meaning);
    return text;
}

std::string describe(const Damage& damage) {
    const std::string line = "line " + std::to_string(damage.line);
    switch (damage.kind) {
        case Damage::Kind::no_status:
            return "it has no status";
        case Damage::Kind::bad_status:
            return "its status is damaged";
        case Damage::Kind::bad_sum:
            return line + " does not match its checksum";
        case Damage::Kind::line_too_long:
            return line + " is too long";
        case Damage::Kind::too_long:
            return "it never ends";
    }
    return {};
}

}  // namespace scipd::protocol::client
