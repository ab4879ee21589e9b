// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/registry.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/sim/backends/contract.h"

namespace scipd::sim {
namespace {

using testing::ThrowsMessage;

TEST(Registry, MakesEveryBackendThatItLists) {
    ASSERT_FALSE(backends().empty());
    for (const BackendInfo& info : backends()) {
        if (!what_lacks(std::string(info.name)).empty()) continue;
        const auto backend = make_backend(info.name, SceneBuilder().build());
        EXPECT_EQ(backend->name(), info.name);
        EXPECT_FALSE(info.description.empty());
    }
}

TEST(Registry, TakesThePreferredOneForAuto) {
    EXPECT_EQ(make_backend("auto", SceneBuilder().build())->name(), backends().front().name);
}

TEST(Registry, NamesTheChoicesWhereThereIsNoSuchBackend) {
    EXPECT_THAT(([] { make_backend("radar", SceneBuilder().build()); }),
                ThrowsMessage<std::invalid_argument>(
                    "no backend 'radar': choose auto, embree, depth, reference"));
}

TEST(Registry, HandsTheSceneOn) {
    const SharedScene scene = SceneBuilder().add(Sphere{1.0}, {}).build();
    for (const BackendInfo& info : backends()) {
        if (!what_lacks(std::string(info.name)).empty()) continue;
        EXPECT_EQ(&make_backend(info.name, scene)->scene(), scene.get());
    }
}

}  // namespace
}  // namespace scipd::sim
