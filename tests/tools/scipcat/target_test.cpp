// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/target.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace scipd::tools {
namespace {

TEST(Target, IsAnAddress) {
    EXPECT_EQ(parse_target("tcp://192.168.0.10:10941"), Target(TcpTarget{"192.168.0.10", "10941"}));
    EXPECT_EQ(parse_target("tcp://[::1]:10941"), Target(TcpTarget{"::1", "10941"}));
    EXPECT_EQ(parse_target("localhost:10941"), Target(TcpTarget{"localhost", "10941"}));
}

TEST(Target, HasTheScannersPortUnlessToldOtherwise) {
    EXPECT_EQ(parse_target("tcp://lidar"), Target(TcpTarget{"lidar", "10940"}));
    EXPECT_EQ(parse_target("tcp://[::1]"), Target(TcpTarget{"::1", "10940"}));
}

TEST(Target, IsAPath) {
    EXPECT_EQ(parse_target("/dev/ttyACM0"), Target(TtyTarget{"/dev/ttyACM0"}));
    EXPECT_EQ(parse_target("./front:left"), Target(TtyTarget{"./front:left"}));
}

TEST(Target, IsNothingElse) {
    for (const char* const text : {"", "lidar", "tcp://", "tcp://:10940", "tcp://lidar:", "lidar:x",
                                   "tcp://lidar:0", "tcp://lidar:65536", "tcp://[::1", ":1"}) {
        EXPECT_THROW((void)parse_target(text), std::invalid_argument) << text;
    }
}

}  // namespace
}  // namespace scipd::tools
