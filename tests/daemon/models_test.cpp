// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// That all products are sound, and say nothing that a driver could not read.
#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/models/profile_check.h"
#include "daemon/models/registry.h"
#include "protocol/device_state.h"
#include "protocol/reports.h"
#include "protocol/scip1.h"

namespace scipd::daemon {
namespace {

using protocol::DeviceState;

class EveryModel : public testing::TestWithParam<Model> {};

TEST_P(EveryModel, IsSound) {
    for (const ProfileFault& fault : faults_of(GetParam().profile))
        ADD_FAILURE() << fault.member << ": " << fault.sentence;
}

/// The longest line of a message.
std::size_t longest_line(std::string_view message) {
    std::size_t longest = 0;
    while (!message.empty()) {
        const std::size_t end = std::min(message.find('\n'), message.size());
        longest = std::max(longest, end);
        message.remove_prefix(std::min(end + 1, message.size()));
    }
    return longest;
}

TEST_P(EveryModel, SaysNoLineThatIsTooLongForUrgLibrary) {
    const auto& profile = GetParam().profile;
    const std::size_t limit = 71;  // its buffer holds 72
    const DeviceState device;
    EXPECT_LE(longest_line(protocol::version_report("VV", profile)), limit);
    EXPECT_LE(longest_line(protocol::parameter_report("PP", profile)), limit);
    EXPECT_LE(longest_line(protocol::state_report("II", profile, device, {})), limit);
    EXPECT_LE(longest_line(protocol::scip1_version("V", profile, device)), limit);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryModel, testing::ValuesIn(models()), [](const auto& model) {
    std::string name = model.param.profile.name + "_" + model.param.profile.release;
    for (char& c : name)
        if (c == '-' || c == '.') c = '_';
    return name;
});

}  // namespace
}  // namespace scipd::daemon
