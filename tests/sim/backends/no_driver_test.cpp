// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A machine whose EGL has no driver: this program hides it before anybody looks.
#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

#include "sim/backends/choice.h"
#include "sim/backends/depth.h"
#include "sim/backends/registry.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class NoDriver : public testing::Test {
  protected:
    static void SetUpTestSuite() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1); }

    SharedScene scene_ = SceneBuilder().add(Box{{10, 10, 10}}, {}).build();
};

TEST_F(NoDriver, IsToldWhereADepthBufferIsAskedFor) {
    EXPECT_THAT([&] { make_backend("depth", scene_); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("libgl1-mesa-dri")));
    EXPECT_THAT(probe_depth(), HasSubstr("libgl1-mesa-dri"));
}

TEST_F(NoDriver, LeavesRaysToTakeOver) {
    const std::vector<glm::vec3> forward{{1, 0, 0}};
    const std::vector<Pose> pose(1);
    const std::vector<Fan> fans{{forward, pose}};
    const Choice choice = choose_backend(scene_, fans, [] {
        return std::chrono::duration_cast<Time>(
            std::chrono::steady_clock::now().time_since_epoch());
    });
    EXPECT_THAT(choice.reason, StartsWith("embree; no depth: EGL offers neither"));
    std::vector<Hit> hits(1);
    choice.backend->cast(fans[0], hits);
    EXPECT_NEAR(hits[0].range_m, 5.0, 1e-4);
}

}  // namespace
}  // namespace scipd::sim
