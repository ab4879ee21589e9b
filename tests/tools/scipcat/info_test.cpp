// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "daemon/models/model_registry.h"
#include "tests/support/tty_rate.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;

TEST(ScipcatInfo, IsReadable) {
    const RoomScanner scanner(daemon::find_model("URG-04LX").profile);
    const Outcome outcome = run_scipcat({"info", scanner.tcp_target()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("URG-04LX\n"));
    EXPECT_THAT(outcome.out, HasSubstr("serial    H0706400\n"));
    EXPECT_THAT(outcome.out, HasSubstr("range     0.020 to 5.600 m\n"));
    EXPECT_THAT(outcome.out, HasSubstr("-119.53 to 119.88 degrees, every 0.3516 (steps 44 to 725, "
                                       "384 looks forward)\n"));
    EXPECT_THAT(outcome.out, HasSubstr("600 rpm, a turn in 100 ms\n"));
    EXPECT_THAT(outcome.out, HasSubstr("health    Sensor works well.\n"));
}

TEST(ScipcatInfo, IsJsonForPrograms) {
    const auto& profile = daemon::find_model("UST-10LX").profile;
    const RoomScanner scanner(profile);
    const Outcome outcome = run_scipcat({"info", scanner.tcp_target(), "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto document = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(document["model"], "UST-10LX");
    EXPECT_EQ(document["serial"], profile.serial);
    EXPECT_EQ(document["dmax_mm"], 30000);
    EXPECT_EQ(document["amax"], 1080);
    EXPECT_EQ(document["laser"], "OFF");
    EXPECT_EQ(document["health"], "sensor is working normally");
    EXPECT_TRUE(document["time_ms"].is_number_unsigned());
}

TEST(ScipcatInfo, WorksByTtyAgainAndAgain) {
    const RoomScanner scanner(daemon::find_model("UTM-30LX").profile);
    for (int i = 0; i < 3; ++i) {
        const Outcome outcome = run_scipcat({"info", scanner.tty()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("serial    00903971\n"));
    }
}

// Some of these have no name in POSIX.
TEST(ScipcatInfo, WorksAtEachRateOfTheScanner) {
    const auto& profile = daemon::find_model("URG-04LX").profile;
    const RoomScanner scanner(profile);
    const int tty = ::open(scanner.tty().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(tty, 0);
    EXPECT_THAT(profile.bit_rates, testing::IsSupersetOf({19200, 250000, 750000}));
    for (const int rate : profile.bit_rates) {
        const Outcome outcome =
            run_scipcat({"info", scanner.tty(), "--baud", std::to_string(rate)});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(tty_rate(tty), rate);
    }
    ::close(tty);
}

}  // namespace
}  // namespace scipd::tests
