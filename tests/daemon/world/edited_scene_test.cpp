// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is told of a model that is added where nobody meant it to be.
#include "daemon/world/edited_scene.h"

#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A floor of 6 m by 4 m.
PresentScene room() {
    auto scene = std::make_shared<sim::Scene>();
    scene->models = {{"room", false, sim::Pose{}}};
    scene->objects = {{"room::link::floor", 0, sim::Pose{}, sim::Box{{6.0, 4.0, 0.1}}}};
    return {"/room.sdf", scene, {}, {}, {}, {}};
}

AddModel crate_at(double x_m, double y_m) {
    AddModel edit;
    edit.placement.name = "crate";
    edit.placement.world_from_model = sim::pose_from_rpy({x_m, y_m, 0.0}, {0.0, 0.0, 0.0});
    edit.sdf =
        "<model name='crate'><link name='l'><visual name='v'><geometry><box><size>1 1 "
        "1</size></box>"
        "</geometry></visual></link></model>";
    return edit;
}

TEST(EditedScene, NotesAModelThatLiesOutsideAsIfByMillimetres) {
    const auto far = edited(crate_at(1500, 500), room());
    ASSERT_TRUE(far);
    EXPECT_THAT(far->warnings, IsEmpty());
    EXPECT_THAT(
        far->notes,
        ElementsAre("pose.xyz: 1500, 500, 0 looks like millimetres, but lengths are metres; "
                    "did you mean 1.5, 0.5, 0?"));
    const auto near = edited(crate_at(1.5, 0.5), room());
    ASSERT_TRUE(near);
    EXPECT_THAT(near->notes, IsEmpty());
}

TEST(EditedScene, HandsOnWhatIsOddAboutTheRequest) {
    AddModel edit = crate_at(1, 0);
    edit.warnings = {"pose.rpy: 0, 0, 90 looks like degrees"};
    const auto added = edited(edit, room());
    ASSERT_TRUE(added);
    EXPECT_THAT(added->warnings, ElementsAre("pose.rpy: 0, 0, 90 looks like degrees"));
    PresentScene strict = room();
    strict.options.sdf.strict = true;
    EXPECT_THROW((void)edited(edit, strict), sim::LoadError);
}

}  // namespace
}  // namespace scipd::daemon
