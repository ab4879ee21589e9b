// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// That all products are sound, and say nothing that a driver could not read.
#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/models/model_list.h"
#include "daemon/models/model_registry.h"
#include "daemon/models/profile_check.h"
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

/// The major and the minor number of a firmware such as 3.3.00(16/Apr./2008); {0, 0}: it has none.
std::pair<int, int> version_of(const std::string& firmware) {
    std::pair<int, int> version;
    std::sscanf(firmware.c_str(), "%d.%d", &version.first, &version.second);
    return version;
}

// A driver concludes from the version what the scanner can do. urg_stamped expects %TM of 1.1 and
// of 4.1 and what is newer of the same line, but for UTM, and a tick of 5 ms of 4.0.0 to 4.0.2.
TEST_P(EveryModel, PromisesUrgStampedWhatItHas) {
    const auto& profile = GetParam().profile;
    const auto [major, minor] = version_of(profile.firmware);
    const bool utm = profile.product.starts_with("UTM");
    EXPECT_EQ(profile.microseconds, !utm && (major == 1 || major == 4) && minor >= 1);
    const bool ticks = profile.firmware.starts_with("4.0.") && profile.firmware[4] <= '2';
    EXPECT_EQ(profile.time_tick, std::chrono::milliseconds(ticks ? 5 : 0));
}

// SCIP 2.0 specification, pages 18 and 19: HS came with 3.2.00, DB with 3.3.00.
TEST_P(EveryModel, HasWhatCameWithItsFirmware) {
    const auto& profile = GetParam().profile;
    if (profile.family != protocol::Family::urg) return;
    const auto version = version_of(profile.firmware);
    EXPECT_EQ(profile.sensitivity == protocol::Support::yes, version >= std::pair(3, 2));
    EXPECT_EQ(profile.rehearsals == protocol::Support::yes, version >= std::pair(3, 3));
}

TEST_P(EveryModel, IsNamedByTheFirmwareThatItTells) {
    const auto& profile = GetParam().profile;
    EXPECT_TRUE(profile.firmware.starts_with(profile.release)) << profile.firmware;
}

TEST_P(EveryModel, SaysHowSureEachFigureIs) {
    const std::string sure = " +(seen|measured|doc|ded|assumed)";
    std::string row = "[^ ]+@[^ ]+";
    for (int i = 0; i < 9; ++i)
        row += sure;
    EXPECT_THAT(list_of({&GetParam(), 1}),
                testing::MatchesRegex(
                    "MODEL +LINKS +RANGE mm +STEPS +SCANS\n"
                    "[^ ]+@[^ ]+  (USB|USB, RS-232|Ethernet) +[0-9]+-[0-9]+ +[0-9]+-[0-9]+ "
                    "of [0-9]+ +[0-9.]+ Hz\n\n"
                    "MODEL +COMMANDS\n[^ ]+@[^ ]+  VV PP II [^\n]+\n\n"
                    "MODEL +CODES +TURN +SCAN LEAVES +BOOT\n[^ ]+@[^ ]+  [0-9 ()]+  [0-9.]+ ms  "
                    "[^\n]+ +[0-9]+ s\n\n[^\n]+\n[^\n]+\n[^\n]+\n\n"
                    "MODEL +LINKS +RANGE +STEPS +SCANS +COMMANDS +TEXTS +NOISE +BIAS +LIGHT\n" +
                    row + "\n\nMODEL +CODES +TURN +SCAN LEAVES +BOOT\n[^ ]+@[^ ]+" + sure + sure +
                    sure + sure + "\n"));
}

TEST(ListOfModels, ListsCodesAndTimes) {
    const std::vector<Model> three{find_model("URG-04LX@3.1.04"), find_model("UXM-30LX-E"),
                                   find_model("UST-30LC@4.0.2-A")};
    EXPECT_THAT(
        list_of(three),
        testing::HasSubstr(
            "MODEL              CODES                        TURN      SCAN LEAVES         BOOT\n"
            "URG-04LX@3.1.04    0 7 9 10 18 19 (1 2 6 8 15)  99.8 ms   every turn          1 s\n"
            "UXM-30LX-E@0.3.01  1 2 3 5                      49.67 ms  every 2 turns       1 s\n"
            "UST-30LC@4.0.2-A   4 65533                      25.05 ms  at once, tick 5 ms  10 "
            "s\n"));
    EXPECT_THAT(list_of(three),
                testing::EndsWith("MODEL              CODES     TURN  SCAN LEAVES  BOOT\n"
                                  "URG-04LX@3.1.04    measured  seen  seen         assumed\n"
                                  "UXM-30LX-E@0.3.01  ded       seen  seen         assumed\n"
                                  "UST-30LC@4.0.2-A   ded       doc   doc          assumed\n"));
}

TEST(ListOfModels, ListsTheCommandsThatAreCarriedOut) {
    const std::vector<Model> two{find_model("URG-04LX@3.1.04"), find_model("UST-30LC@4.1.0b-A")};
    EXPECT_THAT(list_of(two),
                testing::StartsWith(
                    "MODEL              LINKS        RANGE mm  STEPS           SCANS\n"
                    "URG-04LX@3.1.04    USB, RS-232  20-5600   44-725 of 1024  10 Hz\n"
                    "UST-30LC@4.1.0b-A  Ethernet     23-60000  0-1080 of 1440  40 Hz\n"
                    "\n"
                    "MODEL              COMMANDS\n"
                    "URG-04LX@3.1.04    VV PP II BM QT RS GD GS MD MS TM0 TM1 TM2 SS CR SCIP2.0, "
                    "SCIP 1.1\n"
                    "UST-30LC@4.1.0b-A  VV PP II %ST BM QT %SL RS RT RB GD GE MD ME TM0 TM1 TM2 "
                    "%MD %ME %TM1 $IP\n"));
    EXPECT_THAT(list_of(two),
                testing::HasSubstr(
                    "MODEL              LINKS  RANGE  STEPS  SCANS  COMMANDS  TEXTS  NOISE     "
                    "BIAS     LIGHT\n"
                    "URG-04LX@3.1.04    doc    seen   seen   seen   doc       seen   measured  "
                    "assumed  ded\n"
                    "UST-30LC@4.1.0b-A  doc    doc    doc    doc    doc       doc    assumed   "
                    "assumed  ded\n"));
}

TEST(ListOfModels, FitsATerminal) {
    EXPECT_LE(longest_line(list_of(models())), 100U);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryModel, testing::ValuesIn(models()), [](const auto& model) {
    std::string name = model.param.profile.name + "_" + model.param.profile.release;
    for (char& c : name)
        if (c == '-' || c == '.') c = '_';
    return name;
});

}  // namespace
}  // namespace scipd::daemon
