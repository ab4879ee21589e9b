// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A machine whose EGL has no driver: this program hides it before anybody looks.
#include <cstdlib>
#include <stdexcept>

#include <gmock/gmock.h>

#include "sim/backends/depth_probe.h"
#include "sim/backends/registry.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using testing::HasSubstr;

class NoDriver : public testing::Test {
  protected:
    static void SetUpTestSuite() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1); }

    SharedScene scene_ = SceneBuilder().add(Box{{10, 10, 10}}, {}).build();
};

TEST_F(NoDriver, IsToldWhereADepthBufferIsAskedFor) {
    EXPECT_THAT([&] { make_backend("depth", scene_); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("libgl1-mesa-dri")));
    EXPECT_THAT(probe_depth().text, HasSubstr("libgl1-mesa-dri"));
    EXPECT_FALSE(probe_depth().usable);
}

}  // namespace
}  // namespace scipd::sim
