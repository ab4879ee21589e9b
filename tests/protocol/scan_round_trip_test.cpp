// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Encoding and decoding undo each other for whole scans: what a device of any model measured is
// what protocol/client reads, in every format that the model has, for any window and any cluster.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "protocol/client/decoder.h"
#include "protocol/client/scan_message.h"
#include "protocol/command_table.h"
#include "tests/protocol/script_maker.h"
#include "tests/protocol/shell.h"
#include "tests/protocol/shown.h"

namespace scipd::protocol {
namespace {

using client::ScanMessage;
using client::ScanRequest;

// Near and far, codes, and more than two characters can hold.
std::uint32_t distance_at(int step) {
    return static_cast<std::uint32_t>(step) * 40503U % 70'000U;
}

std::uint32_t intensity_at(int step) {
    return static_cast<std::uint32_t>(step) + 7U;
}

StepEchoes echoes_at(int step) {
    const std::uint32_t mm = distance_at(step);
    return {.echo = {{{mm, intensity_at(step)}, {mm + 1000, 2}, {mm + 2000, 3}}},
            .count = 1 + step % 3};
}

/// The message by the specification's words: the value of a group is its nearest distance or,
/// without one, the code of its first step; intensity and further echoes are of the same step. A
/// distance that two characters cannot hold is as good as none.
class Expected {
  public:
    Expected(const DeviceProfile& profile, const ScanRequest& request)
        : profile_(profile), request_(request) {}

    [[nodiscard]] ScanMessage scan() const {
        ScanMessage scan{.request = request_};
        for (int first = request_.first_step; first <= request_.last_step;
             first += request_.cluster) {
            const int step = speaker_of(first);
            scan.distances_mm.push_back(shown(step));
            if (request_.intensity)
                scan.intensities.push_back(measured(step) ? intensity_at(step) : 0);
            if (!request_.echoes) continue;
            const StepEchoes all = echoes_at(step);
            auto& further = scan.further_echoes.emplace_back();
            for (int i = 1; measured(step) && i < all.count; ++i)
                further.push_back(
                    {all.echo[i].distance, request_.intensity ? all.echo[i].intensity : 0});
        }
        return scan;
    }

  private:
    [[nodiscard]] int speaker_of(int first) const {
        const int end = std::min(first + request_.cluster, request_.last_step + 1);
        int best = first;
        for (int step = first; step < end; ++step) {
            if (rank(step) < rank(best)) best = step;
        }
        return best;
    }
    [[nodiscard]] std::uint32_t rank(int step) const {
        const auto mm = static_cast<int>(distance_at(step));
        const bool distance = mm >= profile_.nearest_mm && mm <= profile_.dmax_mm;
        return measured(step) && distance ? distance_at(step) : ~0U;
    }
    [[nodiscard]] std::uint32_t shown(int step) const {
        if (!measured(step)) return profile_.codes.not_measured;
        const bool fits = request_.width > 2 || distance_at(step) < 4096;
        return fits ? distance_at(step) : profile_.codes.nothing;
    }
    [[nodiscard]] bool measured(int step) const {
        return step >= profile_.amin && step <= profile_.amax;
    }

    const DeviceProfile& profile_;
    const ScanRequest& request_;
};

/// The first scan that comes of the request; nothing: none that can be read.
std::optional<ScanMessage> first_scan(const DeviceProfile& profile, const std::string& line) {
    Shell shell(profile);
    shell.distance = distance_at;
    shell.intensity = intensity_at;
    shell.echoes = echoes_at;
    shell.receive("BM\n" + line + "\n");
    shell.advance_to(std::chrono::seconds(1));
    for (const Sent& sent : shell.take_sent()) {
        std::string_view bytes = sent.bytes;
        const auto message = client::Decoder().next(bytes);
        const auto scan = client::parse_scan(message.value());
        if (const auto* good = std::get_if<ScanMessage>(&scan)) return *good;
    }
    return std::nullopt;
}

std::string some_request(Choices& choices, const Command& command, const DeviceProfile& profile) {
    const int first = choices.between(0, profile.last_step);
    const int last = choices.between(first, profile.last_step);
    char digits[16];
    std::snprintf(digits, sizeof digits, "%04d%04d%02d%s", first, last, choices.between(0, 20),
                  command.brings_scans() ? "001" : "");
    return std::string(command.code) + digits;
}

class ScanRoundTrip : public testing::TestWithParam<std::size_t> {
  protected:
    [[nodiscard]] DeviceProfile profile() const {
        DeviceProfile profile = daemon::models()[GetParam()].profile;
        profile.io_lines = profile.family == Family::ust;
        return profile;
    }
};

TEST_P(ScanRoundTrip, BringsBackWhatWasMeasured) {
    const DeviceProfile device = profile();
    Choices choices(GetParam());
    for (const Command& command : command_table()) {
        const bool scan = command.brings_one_scan() || command.brings_scans();
        if (!scan || find_command(command.code, device) != &command) continue;
        for (int i = 0; i < 20; ++i) {
            const std::string line = some_request(choices, command, device);
            const auto message = first_scan(device, line);
            ASSERT_TRUE(message) << line;
            const ScanMessage expected = Expected(device, message->request).scan();
            EXPECT_EQ(message->distances_mm, expected.distances_mm) << line;
            EXPECT_EQ(message->intensities, expected.intensities) << line;
            EXPECT_EQ(message->further_echoes, expected.further_echoes) << line;
        }
    }
}

std::string model_of(const testing::TestParamInfo<std::size_t>& test) {
    return test_name(daemon::models()[test.param].profile);
}

INSTANTIATE_TEST_SUITE_P(Models, ScanRoundTrip,
                         testing::Range(std::size_t{0}, daemon::models().size()), model_of);

}  // namespace
}  // namespace scipd::protocol
