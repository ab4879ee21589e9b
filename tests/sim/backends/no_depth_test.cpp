// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <stdexcept>

#include <gmock/gmock.h>

#include "sim/backends/depth.h"
#include "sim/backends/depth_probe.h"

namespace scipd::sim {
namespace {

using testing::HasSubstr;

TEST(NoDepth, SaysWhatTheBuildLacked) {
    EXPECT_THAT(std::string(depth_description()), HasSubstr("not in this build"));
    EXPECT_THAT(std::string(depth_description()), HasSubstr("libepoxy-dev"));
    EXPECT_THAT(probe_depth().text, HasSubstr("libegl-dev"));
    EXPECT_FALSE(probe_depth().usable);
}

TEST(NoDepth, RefusesToBeMade) {
    EXPECT_THAT([] { make_depth_backend(std::make_shared<const Scene>()); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("not in this build")));
}

}  // namespace
}  // namespace scipd::sim
