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

#include "daemon/world/backend_maker.h"
#include "tests/support/name_of_backend.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;

class WithoutADriver : public testing::Test {
  protected:
    static void SetUpTestSuite() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1); }

    [[nodiscard]] SensorBackends backends() const { return make_backends({&request_, 1}, scene_); }

    sim::SharedScene scene_ = sim::SceneBuilder().add(sim::Box{{1, 1, 1}}, {}).build();
    RequestedBackend request_{.sensor = "robot/scanner",
                              .backend = std::nullopt,
                              .directions = {{1, 0, 0}},
                              .max_range_m = 30.0F};
};

TEST_F(WithoutADriver, AutoIsContentWithRaysAndSaysWhatIsMissing) {
    request_.settled = BackendMaker(scene_).measure(request_, {});
    SensorBackends rays = backends();
    EXPECT_EQ(name_of(rays.of("robot/scanner")), "embree");
    EXPECT_EQ(rays.choice_of("robot/scanner")->backend, "embree");
    EXPECT_THAT(rays.choice_of("robot/scanner")->reason, HasSubstr("libgl1-mesa-dri"));
}

TEST_F(WithoutADriver, AutoComesBackToRaysWhereItWasDrawnBefore) {
    request_.settled =
        std::make_shared<const BackendChoice>(BackendChoice{"depth", "as before", 1});
    EXPECT_EQ(name_of(backends().of("robot/scanner")), "embree");
}

TEST_F(WithoutADriver, WhatIsAskedForByNameIsRefused) {
    request_.backend = "depth";
    EXPECT_THAT([&] { (void)backends(); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("libgl1-mesa-dri")));
}

}  // namespace
}  // namespace scipd::daemon
