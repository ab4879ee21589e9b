// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The context that depth backends of a thread share. Only in builds that have EGL.
#include "sim/backends/depth_device.h"

#include <memory>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "sim/backends/depth.h"
#include "tests/sim/backends/contract.h"

namespace scipd::sim {
namespace {

class DepthDevice : public testing::Test {
  protected:
    void SetUp() override {
        if (const auto why = what_lacks("depth"); !why.empty()) GTEST_SKIP() << why;
    }
};

// Linking and, where it is first drawn with, translating one takes longer than anything else.
TEST_F(DepthDevice, HasOneProgramForAllWhoDrawInAContext) {
    const auto context = depth_context();  // has drawn the picture of its self-test
    const auto refuse_to_make = []() -> unsigned {
        ADD_FAILURE() << "there is one already";
        return 0;
    };
    const unsigned program = context->program(refuse_to_make);
    EXPECT_NE(program, 0U);
    const SharedScene scene = SceneBuilder().add(Box{{2, 2, 2}}, {}).build();
    make_depth_backend(scene).reset();
    EXPECT_EQ(depth_context(), context);
    EXPECT_EQ(context->program(refuse_to_make), program);
    EXPECT_EQ(failure_of_self_test(context), std::nullopt);
}

TEST_F(DepthDevice, KeepsItsProgramOnAnotherThread) {
    const auto context = depth_context();
    context->release();
    std::thread([&] {
        EXPECT_EQ(failure_of_self_test(context), std::nullopt);
        context->release();
    }).join();
    EXPECT_EQ(failure_of_self_test(context), std::nullopt);
}

}  // namespace
}  // namespace scipd::sim
