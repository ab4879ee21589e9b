// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/registry.h"

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include <gmock/gmock.h>

#include "tests/sim/backends/contract.h"
#include "tests/support/backend_names.h"

namespace scipd::sim {
namespace {

using testing::ThrowsMessage;

TEST(Registry, MakesADifferentBackendForEveryRow) {
    std::set<std::type_index> made;
    std::set<std::string_view> names;
    std::size_t makeable = 0;
    for (const BackendRow& row : backends()) {
        names.insert(row.name);
        EXPECT_FALSE(row.description.empty());
        if (!what_lacks(std::string(row.name)).empty()) continue;
        ++makeable;
        const auto backend = make_backend(row.name, SceneBuilder().build());
        made.insert(typeid(*backend));
    }
    EXPECT_GE(makeable, 2U);
    EXPECT_EQ(made.size(), makeable);
    EXPECT_EQ(names.size(), backends().size());
}

TEST(Registry, PrefersWhatIsQuickAndWorksEverywhere) {
    const BackendRow& preferred = preferred_backend();
    EXPECT_FALSE(preferred.slow);
    EXPECT_FALSE(preferred.draws);
    EXPECT_EQ(preferred.probe, nullptr);
}

TEST(Registry, CanProbeTheMachineForWhatDraws) {
    const BackendRow& drawing = drawing_backend();
    ASSERT_NE(drawing.probe, nullptr);
    EXPECT_EQ(drawing.probe().usable, what_lacks(std::string(drawing.name)).empty());
}

TEST(Registry, FindsRowsByTheirNames) {
    for (const BackendRow& row : backends())
        EXPECT_EQ(find_backend(row.name), &row);
    EXPECT_EQ(find_backend("auto"), nullptr);  // a word of the daemon
}

TEST(Registry, NamesTheChoicesWhereThereIsNoSuchBackend) {
    EXPECT_THAT(([] { make_backend("radar", SceneBuilder().build()); }),
                ThrowsMessage<std::invalid_argument>("no backend 'radar': choose " +
                                                     tests::listed_backends()));
}

TEST(Registry, HandsTheSceneOn) {
    const SharedScene scene = SceneBuilder().add(Sphere{1.0}, {}).build();
    for (const BackendRow& row : backends()) {
        if (!what_lacks(std::string(row.name)).empty()) continue;
        EXPECT_EQ(&make_backend(row.name, scene)->scene(), scene.get());
    }
}

}  // namespace
}  // namespace scipd::sim
