// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/run_directory.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace scipd::daemon {
namespace {

TEST(RunDirectory, TakesTheFirstThatIsSet) {
    setenv("RUNTIME_DIRECTORY", "/run/scipd:/run/more", 1);
    setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
    EXPECT_EQ(run_directory(), "/run/scipd");
    setenv("RUNTIME_DIRECTORY", "", 1);
    EXPECT_EQ(run_directory(), "/run/user/7/scipd");
    unsetenv("RUNTIME_DIRECTORY");
    EXPECT_EQ(run_directory(), "/run/user/7/scipd");
    unsetenv("XDG_RUNTIME_DIR");
    EXPECT_EQ(run_directory(), "/tmp/scipd-" + std::to_string(getuid()));
}

}  // namespace
}  // namespace scipd::daemon
