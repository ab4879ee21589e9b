// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipbench load as a user starts it, with scanners that are no scipd.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "daemon/models/model_registry.h"
#include "tests/support/child.h"
#include "tests/support/loopback_scanner.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;

Outcome load(std::vector<std::string> words) {
    words.insert(words.begin(), {SCIPBENCH, "load"});
    return run(words);
}

TEST(ScipbenchLoad, ReadsSeveralScannersByTcpAndTty) {
    const auto reading = [](int step) { return Reading{1000U + static_cast<unsigned>(step), 0}; };
    const LoopbackScanner ust(daemon::find_model("UST-10LX").profile, reading);
    const LoopbackScanner urg(daemon::find_model("URG-04LX-UG01").profile, reading);
    const Outcome outcome = load({"--seconds", "2", "--json", ust.tcp_target(), urg.tty()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    const auto told = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(told["streams"].size(), 2U);
    EXPECT_EQ(told["streams"][0]["model"], "UST-10LX");
    EXPECT_GT(told["streams"][0]["scans"], 20);
    EXPECT_GT(told["streams"][1]["scans"], 5);
    EXPECT_EQ(told["missing"], 0);
    EXPECT_GT(told["streams"][0]["bytes"], 20 * 3300);
}

TEST(ScipbenchLoad, SaysWhichTargetItCannotUse) {
    const Outcome nobody = load({"tcp://127.0.0.1:1"});
    EXPECT_EQ(nobody.exit_code, 1);
    EXPECT_THAT(nobody.err, HasSubstr("cannot connect to 127.0.0.1 port 1"));
    EXPECT_EQ(load({"tcp://"}).exit_code, 2);
    EXPECT_EQ(load({}).exit_code, 2);
}

}  // namespace
}  // namespace scipd::tests
