// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Backends of sensors on a machine whose EGL has no driver: this program hides it before anybody
// looks.
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "daemon/world/backend_workshop.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;

class WithoutADriver : public testing::Test {
  protected:
    static void SetUpTestSuite() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1); }

    [[nodiscard]] SensorBackends backends() const { return make_backends({&wish_, 1}, scene_); }

    sim::SharedScene scene_ = sim::SceneBuilder().add(sim::Box{{1, 1, 1}}, {}).build();
    BackendWish wish_{.sensor = "robot/scanner",
                      .backend = "auto",
                      .directions = {{1, 0, 0}},
                      .max_range_m = 30.0F};
};

TEST_F(WithoutADriver, AutoIsContentWithRaysAndSaysWhatIsMissing) {
    wish_.settled = BackendWorkshop(scene_).measure(wish_, {});
    const SensorBackends rays = backends();
    EXPECT_EQ(rays.of("robot/scanner").name(), "embree");
    EXPECT_EQ(rays.choice_of("robot/scanner")->backend, "embree");
    EXPECT_THAT(rays.choice_of("robot/scanner")->reason, HasSubstr("libgl1-mesa-dri"));
}

TEST_F(WithoutADriver, AutoComesBackToRaysWhereItWasDrawnBefore) {
    wish_.settled = std::make_shared<const BackendChoice>(BackendChoice{"depth", "as before", 1});
    EXPECT_EQ(backends().of("robot/scanner").name(), "embree");
}

TEST_F(WithoutADriver, WhatIsAskedForByNameIsRefused) {
    wish_.backend = "depth";
    EXPECT_THAT([&] { (void)backends(); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("libgl1-mesa-dri")));
}

}  // namespace
}  // namespace scipd::daemon
