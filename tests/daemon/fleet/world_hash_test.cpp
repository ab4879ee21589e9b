// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Two worlds have the same number exactly where they are the same.
#include "daemon/fleet/world_hash.h"

#include <functional>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "sim/world/script.h"

namespace scipd::daemon {
namespace {

sim::Scene world() {
    sim::Scene scene;
    scene.materials = {{"default"}, {"wood"}};
    scene.models = {{.name = "crate", .movable = true}, {.name = "wall"}};
    const sim::Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    scene.objects = {{.name = "a", .model = 0, .shape = sim::Box{{1, 1, 1}}, .material = 1},
                     {.name = "b", .model = 1, .shape = std::make_shared<const sim::Mesh>(mesh)}};
    return scene;
}

TEST(WorldHash, ChangesWithAllThatCastsOrMoves) {
    const std::vector<std::function<void(sim::Scene&)>> changes{
        [](sim::Scene&) {},
        [](sim::Scene& scene) { scene.models[0].name = "box"; },
        [](sim::Scene& scene) { scene.models[0].movable = false; },
        [](sim::Scene& scene) { scene.models[1].world_from_model.translation_m.x = 1e-5; },
        [](sim::Scene& scene) { scene.models[1].world_from_model.translation_m.x = -1e-5; },
        [](sim::Scene& scene) { scene.models[0].world_from_model.rotation.x = 1; },
        [](sim::Scene& scene) { std::get<sim::Box>(scene.objects[0].shape).size_m.z = 2; },
        [](sim::Scene& scene) { scene.objects[0].shape = sim::Sphere{1}; },
        [](sim::Scene& scene) { scene.objects[0].material = 0; },
        [](sim::Scene& scene) { scene.objects[0].model = 1; },
        [](sim::Scene& scene) { scene.objects.pop_back(); },
        [](sim::Scene& scene) {
            scene.models[0].script = std::make_shared<const sim::Script>(
                sim::Script{{{sim::Time(0), {}}, {sim::Time(1), {}}}, {}});
        },
        [](sim::Scene& scene) {
            const sim::Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 1}}};
            scene.objects[1].shape = std::make_shared<const sim::Mesh>(mesh);
        }};
    std::set<std::string> hashes;
    for (const auto& change : changes) {
        sim::Scene scene = world();
        change(scene);
        EXPECT_EQ(content_hash(scene), content_hash(scene));
        hashes.insert(content_hash(scene));
    }
    EXPECT_EQ(hashes.size(), changes.size());
}

TEST(WorldHash, LeavesRoomForAnotherMachinesRounding) {
    sim::Scene scene = world();
    scene.models[0].world_from_model.translation_m = {0.1 + 0.2, 1e-12, -1e-12};
    sim::Scene other = world();
    other.models[0].world_from_model.translation_m = {0.3, 0.0, 0.0};
    EXPECT_EQ(content_hash(scene), content_hash(other));
    EXPECT_EQ(content_hash(scene).size(), 16U);
}

}  // namespace
}  // namespace scipd::daemon
