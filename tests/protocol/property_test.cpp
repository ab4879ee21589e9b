// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What holds whatever clients say and whatever happens, for every model, in some thousand scripts
// that are the same in each run. A script that fails is told with its seed and cut down to the
// events that it takes; SCIPD_SEED=N runs that seed alone.
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "tests/protocol/script.h"
#include "tests/protocol/script_maker.h"
#include "tests/protocol/shown.h"

namespace scipd::protocol {
namespace {

using Check = std::function<std::string(const Script&)>;

constexpr std::uint64_t seeds = 60;

/// Without any event that it does not take to fail.
Script shrunk(Script script, const Check& fault_in) {
    for (std::size_t size = script.events.size() / 2; size > 0; size /= 2) {
        for (std::size_t begin = 0; begin + size <= script.events.size();) {
            Script shorter = script;
            const auto first = shorter.events.begin() + static_cast<std::ptrdiff_t>(begin);
            shorter.events.erase(first, first + static_cast<std::ptrdiff_t>(size));
            if (fault_in(shorter).empty()) {
                begin += size;
            } else {
                script = std::move(shorter);
            }
        }
    }
    return script;
}

void expect_no_fault(const Script& script, std::uint64_t seed, const Check& fault_in) {
    const std::string fault = fault_in(script);
    if (fault.empty()) return;
    const Script shortest = shrunk(script, fault_in);
    FAIL() << "SCIPD_SEED=" << seed << ": " << fault
           << "\nas short as it gets: " << fault_in(shortest) << "\n"
           << to_text(shortest);
}

/// The first of `expected` that is not in the same place of `told`, which may go on for longer.
std::string difference(const std::vector<Sent>& expected, const std::vector<Sent>& told) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (i < told.size() && told[i] == expected[i]) continue;
        const std::string instead = i < told.size() ? to_text(told[i]) : "nothing more";
        return "message " + std::to_string(i) + " is\n  " + instead + "\nin the place of\n  " +
               to_text(expected[i]);
    }
    return {};
}

class AnyConversation : public testing::TestWithParam<std::size_t> {
  protected:
    void for_each_seed(int clients, const Check& fault_in) {
        const char* const only = std::getenv("SCIPD_SEED");
        const std::uint64_t first = only == nullptr ? 0 : std::strtoull(only, nullptr, 10);
        const std::uint64_t end = only == nullptr ? seeds : first + 1;
        for (std::uint64_t seed = first; seed < end && !HasFailure(); ++seed) {
            Choices choices(seed * 1000 + GetParam());
            expect_no_fault(make_script(choices, profile(), clients), seed, fault_in);
        }
    }
    [[nodiscard]] const DeviceProfile& profile() const {
        return daemon::models()[GetParam()].profile;
    }
};

// Each message is whole, adds up, can be read by protocol/client and is no longer than its request
// permits; each client gets the answers to its own requests, all of them, in their order, and the
// scans of its own stream.
TEST_P(AnyConversation, IsAnsweredWithWholeMessagesToWhoAsked) {
    for (const int clients : {1, 3})
        for_each_seed(clients, [](const Script& script) { return perform(script).fault; });
}

TEST_P(AnyConversation, IsAnsweredTheSameAtTheSameInstantsInAnyPieces) {
    for_each_seed(2, [](const Script& script) -> std::string {
        const Outcome whole = perform(script);
        for (std::uint64_t cut = 0; cut < 2; ++cut) {
            Choices choices(cut);
            const Outcome in_pieces = perform(in_fragments(script, choices));
            for (std::size_t client = 0; client < whole.told.size(); ++client) {
                const auto& told = in_pieces.told[client];
                std::string fault = difference(whole.told[client], told);
                if (fault.empty()) fault = difference(told, whole.told[client]);
                if (!fault.empty()) return fault;
            }
        }
        return {};
    });
}

// One client only asks what the device is; the other must not notice.
TEST_P(AnyConversation, IsNotChangedByAnotherClientsQuestions) {
    for_each_seed(1, [](const Script& alone) -> std::string {
        Script beside = alone;
        beside.clients = 2;
        for (std::size_t i = 0; i < beside.events.size(); i += 2) {
            const Event question{
                .kind = Event::Kind::say, .client = 1, .bytes = i % 4 == 0 ? "VV\nII\n" : "PP\nXX"};
            beside.events.insert(beside.events.begin() + static_cast<std::ptrdiff_t>(i), question);
        }
        return difference(perform(alone).told.front(), perform(beside).told.front());
    });
}

std::string name_of(const testing::TestParamInfo<std::size_t>& test) {
    return test_name(daemon::models()[test.param].profile);
}

INSTANTIATE_TEST_SUITE_P(Models, AnyConversation,
                         testing::Range(std::size_t{0}, daemon::models().size()), name_of);

}  // namespace
}  // namespace scipd::protocol
