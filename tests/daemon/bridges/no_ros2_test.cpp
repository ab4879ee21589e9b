// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a build without Cyclone DDS says. It is built into no program, but here.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"
#include "tests/daemon/bridges/heard_by.h"

namespace scipd::daemon {
namespace {

using ::testing::HasSubstr;

TEST(NoRos2, TellsWhatIsMissingAndWithWhichPackageItComes) {
    const auto built = check_ros2_is_built();
    ASSERT_FALSE(built);
    EXPECT_THAT(built.error().why, HasSubstr("built without Cyclone DDS"));
    EXPECT_THAT(built.error().why, HasSubstr("install cyclonedds-dev"));
    tests::Kept kept;
    EXPECT_THROW(listen_to_ros2({.topic = "/odom"}, kept), std::runtime_error);
}

}  // namespace
}  // namespace scipd::daemon
