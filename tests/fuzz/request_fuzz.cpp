// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes at any time to a scanner of any family. The first byte chooses the model, whether it
// counts as a multi-echo one on Ethernet, its reply grid and its size. The rest is instructions: a
// byte says how many of the client's bytes follow or, from 0x80 on, how long to wait. Every message
// must be whole and framed, and the same bytes sent one at a time must give the same answers.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/models/model_registry.h"
#include "protocol/checksum.h"
#include "protocol/data_block.h"
#include "protocol/ideal.h"
#include "protocol/line_reader.h"
#include "tests/protocol/shell.h"

namespace {

using namespace scipd;
using namespace std::chrono_literals;

void demand(bool fact) {
    if (!fact) std::abort();
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    demand(end != std::string_view::npos);
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    return line;
}

// A message has an echo, lines with their sums, and an empty line at the end and nowhere else. It
// has at most three echoes with intensity for each step.
void demand_framed(std::string_view message) {
    constexpr std::size_t longest_line = 71;  // urg_library has room for this much
    constexpr std::size_t head = protocol::LineReader::max_length + 20;
    demand(message.size() <= head + protocol::data_block_size(std::size_t{20} * 2161, 1));
    demand(!take_line(message).empty());
    const std::string_view status = take_line(message);
    if (status == "0" || status == "E") {  // SCIP 1.1, which has no sums
        while (!take_line(message).empty()) {
        }
        return demand(message.empty());
    }
    demand(status.size() == 3 && protocol::checksum(status.substr(0, 2)) == status[2]);
    for (std::string_view line = take_line(message); !line.empty(); line = take_line(message)) {
        demand(line.size() <= longest_line);
        std::string_view summed = line.substr(0, line.size() - 1);
        const bool entry = summed.size() > 5 && summed[4] == ':' && summed.ends_with(';');
        const bool fits = protocol::checksum(summed) == line.back();
        const bool fits_as_entry =
            entry && protocol::checksum(summed.substr(0, summed.size() - 1)) == line.back();
        demand(fits || fits_as_entry);
    }
    demand(message.empty());
}

// Uses a twelfth of the steps unless the input asks for all: this reaches as much code in a tenth
// of the time.
protocol::DeviceProfile profile_of(std::uint8_t choice) {
    const auto& models = daemon::models();
    protocol::DeviceProfile profile = models[choice % models.size()].profile;
    if ((choice & 0x20U) == 0) {
        for (int* steps : {&profile.ares, &profile.amin, &profile.amax, &profile.last_step})
            *steps /= 12;
    }
    if ((choice & 0x40U) != 0) {
        profile.family = protocol::Family::ethernet_multi_echo;
        profile.multi_echo = true;
    }
    profile.microseconds = profile.io_lines = profile.family == protocol::Family::ust;
    if ((choice & 0x80U) != 0) profile = protocol::ideal(profile);
    return profile;
}

constexpr auto longest_conversation = 3s;

std::string conversation(std::string_view script, bool byte_by_byte) {
    protocol::Shell shell(profile_of(static_cast<std::uint8_t>(script.front())));
    shell.distance = [](int step) { return static_cast<std::uint32_t>(step * 37 % 65536); };
    shell.echoes = [](int step) {
        const auto near = static_cast<std::uint32_t>(step * 37 % 65536);
        return protocol::StepEchoes{.echo = {{{near, 1}, {near + 1000, 2}, {near + 2000, 3}}},
                                    .count = 1 + step % 3};
    };
    script.remove_prefix(1);
    while (!script.empty()) {
        const auto instruction = static_cast<std::uint8_t>(script.front());
        script.remove_prefix(1);
        if (instruction >= 0x80U) {
            const auto wait = (instruction - 0x7FU) * 900us;
            if (shell.now() < longest_conversation) shell.advance_to(shell.now() + wait);
            continue;
        }
        const std::string_view bytes = script.substr(0, instruction);
        script.remove_prefix(bytes.size());
        for (std::size_t begin = 0; begin < bytes.size() && byte_by_byte; ++begin)
            shell.receive(bytes.substr(begin, 1));
        if (!byte_by_byte) shell.receive(bytes);
    }
    shell.advance_to(shell.now() + 120ms);
    std::string all;
    for (const protocol::Sent& sent : shell.take_sent()) {
        demand_framed(sent.bytes);
        all += sent.bytes;
    }
    return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0 || size > 600) return 0;
    const std::string_view script(reinterpret_cast<const char*>(data), size);
    demand(conversation(script, false) == conversation(script, true));
    return 0;
}
