// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a build without Gazebo's transport says. It is built into no program, but here.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"
#include "tests/daemon/bridges/heard_by.h"

namespace scipd::daemon {
namespace {

using ::testing::HasSubstr;

TEST(NoGz, TellsWhatIsMissingAndWithWhichPackageItComes) {
    const auto built = check_gz_is_built();
    ASSERT_FALSE(built);
    EXPECT_THAT(built.error().why, HasSubstr("built without Gazebo's transport"));
    EXPECT_THAT(built.error().why, HasSubstr("install libignition-transport-dev"));
    tests::Kept kept;
    EXPECT_THROW(listen_to_gz({"/poses"}, kept), std::runtime_error);
}

}  // namespace
}  // namespace scipd::daemon
