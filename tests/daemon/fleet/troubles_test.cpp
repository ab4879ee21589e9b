// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/fleet/kept_messages.h"

namespace scipd::daemon {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

FleetConfig plain() {
    FleetConfig config;
    config.broker = {"10.0.0.5", 1884};
    config.world = "hall";
    return config;
}

TEST(Troubles, AreToldWithWhatTakesThemAway) {
    Troubles troubles(plain());
    EXPECT_EQ(troubles.text(), "");
    EXPECT_TRUE(troubles.set("scipd/hall/models/post", "name is missing"));
    EXPECT_FALSE(troubles.set("scipd/hall/models/post", "name is missing"));
    EXPECT_EQ(troubles.text(),
              "scipd/hall/models/post: name is missing; `mosquitto_pub -h 10.0.0.5 -p 1884 -q 1 -r "
              "-n -t scipd/hall/models/post` takes the message away");
    EXPECT_TRUE(troubles.set("scipd/hall/scene", "is another one"));
    EXPECT_THAT(troubles.text(),
                AllOf(StartsWith("scipd/hall/models/post: "), EndsWith(" (and others)")));
    EXPECT_FALSE(troubles.set("scipd/hall/models/crate", "is the first in the alphabet"));
    EXPECT_FALSE(troubles.set("scipd/hall/models/crate", ""));
    EXPECT_TRUE(troubles.set("scipd/hall/models/post", ""));
    EXPECT_THAT(troubles.text(), StartsWith("scipd/hall/scene: is another one; "));
    EXPECT_TRUE(troubles.set("scipd/hall/scene", ""));
    EXPECT_EQ(troubles.text(), "");
    EXPECT_FALSE(troubles.set("scipd/hall/scene", ""));
}

TEST(Troubles, NameTheOptionsThatTheBrokerWants) {
    FleetConfig config = plain();
    config.broker.tls = true;
    config.user = {"tug", "secret"};
    EXPECT_THAT(command_to_clear(config, "t"),
                AllOf(HasSubstr("--capath /etc/ssl/certs"), HasSubstr("-u tug -P PASSWORD")));
    config.tls = {.ca = "ca.pem", .cert = "c.pem", .key = "k.pem"};
    EXPECT_THAT(command_to_clear(config, "t"),
                HasSubstr("--cafile ca.pem --cert c.pem --key k.pem"));
}

// Ten thousand junk models made 2 MB of log.
TEST(Troubles, AreNotEachToldInTheLog) {
    testing::internal::CaptureStdout();  // where the log goes without a daemon
    Troubles troubles(plain());
    for (int i = 0; i < 10'000; ++i)
        troubles.set("scipd/hall/models/" + std::to_string(i), "name is missing");
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_LT(std::ranges::count(said, '\n'), 100);
    EXPECT_THAT(said, HasSubstr("scipd/hall/models/0: name is missing"));
    EXPECT_THAT(troubles.text(), EndsWith(" (and others)"));
}

}  // namespace
}  // namespace scipd::daemon
