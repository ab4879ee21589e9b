// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures how long it takes to write a scan of 1081 ranges as SCIP text: the data block alone, and
// the whole message of a stream. It compares with code that goes character by character.
//
//   build/release/bin/encode_bench
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "daemon/models/model_registry.h"
#include "protocol/char_code.h"
#include "protocol/checksum.h"
#include "protocol/data_block.h"
#include "protocol/subscription.h"

namespace {

using namespace scipd;

constexpr std::size_t steps = 1081;

std::vector<std::uint32_t> ranges() {
    std::vector<std::uint32_t> values;
    for (std::uint32_t step = 0; step < steps; ++step)
        values.push_back(500 + step * 7919 % 29000);
    return values;
}

void data_block(benchmark::State& state) {
    const int width = static_cast<int>(state.range(0));
    std::vector<std::uint32_t> values = ranges();
    for (std::uint32_t& value : values)
        value &= static_cast<std::uint32_t>(protocol::max_encoded(width));
    std::string text;
    for (auto _ : state) {
        text.clear();
        protocol::append_data_block(text, values, width);
        benchmark::DoNotOptimize(text.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps));
}
BENCHMARK(data_block)->ArgName("characters")->Arg(3)->Arg(2);

void character_by_character(benchmark::State& state) {
    const std::vector<std::uint32_t> values = ranges();
    std::string characters;
    std::string text;
    for (auto _ : state) {
        characters.clear();
        text.clear();
        for (const std::uint32_t value : values)
            protocol::append_encoded(characters, value, 3);
        for (std::size_t begin = 0; begin < characters.size();
             begin += protocol::data_line_length) {
            const auto line =
                std::string_view(characters).substr(begin, protocol::data_line_length);
            text.append(line).push_back(protocol::checksum(line));
            text.push_back('\n');
        }
        benchmark::DoNotOptimize(text.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps));
}
BENCHMARK(character_by_character);

void whole_message(benchmark::State& state, const std::string& request) {
    const protocol::DeviceProfile& profile = daemon::find_model("UST-10LX").profile;
    auto stream = std::get<protocol::Subscription>(protocol::Subscription::from(
        protocol::parse_request({request}, profile), {}, profile.scan_period, profile));
    const std::vector<std::uint32_t> values = ranges();
    const protocol::ScanView scan{{}, 0, values, values};
    for (auto _ : state) {
        std::string text = stream.message(scan, {}, profile);
        benchmark::DoNotOptimize(text.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps));
}
BENCHMARK_CAPTURE(whole_message, distances, "MD0000108001000");
BENCHMARK_CAPTURE(whole_message, distances_in_fours, "MD0000108004000");
BENCHMARK_CAPTURE(whole_message, with_intensity, "ME0000108001000");

}  // namespace

BENCHMARK_MAIN();
