// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/script_maker.h"

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/command_table.h"
#include "protocol/ideal.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

std::string digits(int value, std::size_t width) {
    std::string text = std::to_string(value);
    if (text.size() < width) text.insert(0, width - text.size(), '0');
    return text.substr(text.size() - width);
}

char any_byte(Choices& choices) {
    return static_cast<char>(choices.below(256));
}

std::string window(Choices& choices, const DeviceProfile& profile) {
    constexpr std::array codes = {"FF", "FE", "EF", "DF", "DC"};
    int first = choices.between(0, profile.last_step);
    int last = choices.one_in(4) ? profile.amax : std::min(first + 40, profile.last_step);
    if (choices.one_in(8)) first = profile.amin;
    if (choices.one_in(32)) last = choices.between(0, 9999);
    const int clusters[] = {0, 1, 1, 1, 2, 3, 99};
    std::string cluster = digits(choices.of(clusters), 2);
    if (choices.one_in(8)) cluster = choices.of(codes);
    return digits(first, 4) + digits(last, 4) + cluster;
}

std::string scans(Choices& choices, const DeviceProfile& profile) {
    const int intervals[] = {0, 0, 0, 1, 9};
    const int counts[] = {0, 1, 2, 30, 99};
    return window(choices, profile) + digits(choices.of(intervals), 1) +
           digits(choices.of(counts), 2);
}

std::string parameters(Choices& choices, Parameters kind, const DeviceProfile& profile) {
    constexpr std::array rates = {19200, 38400, 115200, 750000, 1};
    switch (kind) {
        case Parameters::none:
            return "";
        case Parameters::digit:
            return digits(choices.between(0, 9), 1);
        case Parameters::number:
            return digits(choices.one_in(8) ? 99 : choices.between(0, 11), 2);
        case Parameters::rate:
            return digits(choices.of(rates), 6);
        case Parameters::window:
            return window(choices, profile);
        case Parameters::scans:
            return scans(choices, profile);
        case Parameters::addresses:
            return "192168000010255255255000192168000001";
    }
    return "";
}

std::string string_of_client(Choices& choices) {
    const auto length = static_cast<std::size_t>(choices.between(0, 17));
    std::string text = ";";
    while (text.size() < length)
        text += static_cast<char>('a' + choices.below(26));
    if (choices.one_in(16)) text += any_byte(choices);
    return text;
}

// Now and then one that the model does not know.
const Command& some_command(Choices& choices, const DeviceProfile& profile) {
    const Command* command = nullptr;
    for (int attempt = 0; attempt < 4; ++attempt) {
        command = &choices.of(command_table());
        if (command->gate(profile.family).known() && profile.has(command->needs)) break;
    }
    return *command;
}

std::string request(Choices& choices, const DeviceProfile& profile) {
    const Command& command = some_command(choices, profile);
    std::string text(command.code);
    text += parameters(choices, command.parameters, profile);
    if (choices.one_in(24)) text.pop_back();
    if (choices.one_in(24)) text += any_byte(choices);
    if (choices.one_in(3)) text += string_of_client(choices);
    if (choices.one_in(24)) text[choices.below(static_cast<std::uint32_t>(text.size()))] = 'x';
    return text;
}

/// What takes a device from state to state, as clients put it.
std::string habit(Choices& choices, const DeviceProfile& profile) {
    const std::string whole = digits(profile.amin, 4) + digits(profile.amax, 4) + "01";
    const std::string habits[] = {"BM",
                                  "QT",
                                  "TM0",
                                  "TM1",
                                  "TM2",
                                  "RS",
                                  "RB\nRB",
                                  "%SL",
                                  "%ST",
                                  "VV\nPP",
                                  "II",
                                  "MD" + whole + "000",
                                  "GD" + whole,
                                  "ME" + whole + "030",
                                  "NE" + whole + "002",
                                  "SCIP2.0",
                                  "V",
                                  "L0",
                                  "L1",
                                  "G04472501",
                                  "S0192000000000",
                                  "DB01",
                                  "DB04",
                                  "DB10"};
    return choices.of(habits);
}

std::string noise(Choices& choices) {
    std::string text;
    const int length = choices.one_in(8) ? choices.between(120, 300) : choices.between(0, 20);
    while (static_cast<int>(text.size()) < length && !choices.exhausted())
        text += any_byte(choices);
    return text;
}

Uptime some_time(Choices& choices, const DeviceProfile& profile) {
    switch (choices.below(8)) {
        case 0:
            return choices.between(1, 999) * 1ns;
        case 1:
        case 2:
            return choices.between(1, 3000) * 1us;
        default:
            return choices.between(1, 2500) * profile.scan_period / 1000;
    }
}

Event event(Choices& choices, const DeviceProfile& profile, int clients) {
    const int client = choices.between(0, clients - 1);
    const std::uint32_t kind = choices.below(64);
    if (kind < 40)
        return {.kind = Event::Kind::say, .client = client, .bytes = make_saying(choices, profile)};
    if (kind < 57) return {.kind = Event::Kind::wait, .time = some_time(choices, profile)};
    if (kind < 58) return {.kind = Event::Kind::boot};
    if (kind < 60) return {.kind = Event::Kind::hang_up, .client = client};
    if (kind < 63)
        return {.kind = Event::Kind::trouble,
                .trouble = static_cast<Trouble>(choices.one_in(2) ? 0 : choices.below(4))};
    return {.kind = Event::Kind::power_cycle};
}

/// A boot throws away what has come by then.
bool may_boot(const Script& script) {
    return std::ranges::any_of(script.events, [](const Event& event) {
        return event.kind == Event::Kind::power_cycle ||
               event.bytes.find("RB") != std::string::npos;
    });
}

/// Takes the beginning of a line off the front; it may come as early as one likes.
std::string take_head(std::string& bytes, Choices& choices) {
    const std::size_t line = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const std::string head = bytes.substr(0, choices.below(static_cast<std::uint32_t>(line + 1)));
    bytes.erase(0, head.size());
    return head;
}

void cut_saying(const Event& saying, Choices& choices, std::vector<Event>& events) {
    for (std::size_t begin = 0; begin < saying.bytes.size();) {
        const std::size_t length = choices.one_in(4) ? saying.bytes.size() : 1 + choices.below(4);
        events.push_back(saying);
        events.back().bytes = saying.bytes.substr(begin, length);
        begin += length;
    }
}

}  // namespace

std::uint32_t Choices::below(std::uint32_t count) {
    if (!from_bytes_) {  // SplitMix64
        std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15U;
        mixed = (mixed ^ mixed >> 30U) * 0xBF58476D1CE4E5B9U;
        mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
        return static_cast<std::uint32_t>((mixed ^ mixed >> 31U) >> 32U) % count;
    }
    std::uint32_t value = 0;
    for (std::uint32_t most = count - 1; most > 0 && !bytes_.empty(); most >>= 8U) {
        value = value << 8U | static_cast<unsigned char>(bytes_.front());
        bytes_.remove_prefix(1);
    }
    return value % count;
}

std::string make_saying(Choices& choices, const DeviceProfile& profile) {
    constexpr std::array ends = {"\n", "\n", "\n", "\n", "\n", "\r", "\r\n", ""};
    const std::uint32_t kind = choices.below(16);
    std::string text = kind < 9    ? request(choices, profile)
                       : kind < 15 ? habit(choices, profile)
                                   : noise(choices);
    return text + choices.of(ends);
}

Script make_script(Choices& choices, const DeviceProfile& profile, int clients) {
    constexpr int most_events = 60;
    Script script{.profile = choices.one_in(8) ? ideal(profile) : profile, .clients = clients};
    script.profile.io_lines = profile.family == Family::ust && choices.one_in(2);
    if (choices.one_in(4)) script.power_up = Script::PowerUp::cold;
    if (profile.speaks_scip1() && choices.one_in(3)) script.power_up = Script::PowerUp::scip1;
    script.clock_wraps = choices.one_in(8);
    const int count = choices.between(1, most_events);
    while (static_cast<int>(script.events.size()) < count && !choices.exhausted())
        script.events.push_back(event(choices, script.profile, clients));
    // Rehearsals act in streams of more than 20 scans.
    if (choices.one_in(2))
        script.events.push_back({.kind = Event::Kind::wait, .time = 25 * profile.scan_period});
    return script;
}

Script in_fragments(const Script& script, Choices& choices) {
    std::vector<Event> events;
    std::vector<Event> whole = script.events;
    const bool early = !may_boot(script);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const Event& event = whole[i];
        if (event.kind == Event::Kind::say) {
            cut_saying(event, choices, events);
        } else if (event.kind == Event::Kind::wait) {
            const Uptime first = event.time * choices.between(0, 16) / 16;
            events.push_back({.kind = Event::Kind::wait, .time = first});
            if (early && i + 1 < whole.size() && whole[i + 1].kind == Event::Kind::say) {
                Event& next = whole[i + 1];
                events.push_back({.kind = Event::Kind::say,
                                  .client = next.client,
                                  .bytes = take_head(next.bytes, choices)});
            }
            events.push_back({.kind = Event::Kind::wait, .time = event.time - first});
        } else {
            events.push_back(event);
        }
    }
    Script cut = script;
    cut.events = std::move(events);
    return cut;
}

}  // namespace scipd::protocol
