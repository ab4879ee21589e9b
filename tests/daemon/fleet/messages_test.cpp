// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What daemons say to each other: frames of poses, notes, and models.
#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/fleet/model_message.h"
#include "daemon/fleet/notes.h"
#include "daemon/fleet/pose_frame.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(PoseFrame, IsReadAsItWasWritten) {
    const sim::PoseLine box{.model = "a \"box\"",
                            .time = sim::Time(1'234'567'891),
                            .pose = {{1.0, -2.5, 1e-9}, {0.5, 0.5, -0.5, 0.5}},
                            .velocity = sim::Velocity{{1.0, 0.0, 0.1}, {0.0, 0.0, -3.0}}};
    const sim::PoseLine robot{.robot = "east", .pose = {{0.1, 0.2, 0.3}}};
    std::string frame = frame_head("north");
    append_line(frame, box);
    append_line(frame, robot);
    EXPECT_EQ(sender_of(frame), "north");
    const auto lines = poses_in(frame);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].model, box.model);
    EXPECT_EQ(lines[0].time, box.time);
    EXPECT_EQ(lines[0].pose, box.pose);
    EXPECT_EQ(lines[0].velocity, box.velocity);
    EXPECT_EQ(lines[1].robot, "east");
    EXPECT_EQ(lines[1].time, std::nullopt);
    EXPECT_EQ(lines[1].pose, robot.pose);
}

TEST(PoseFrame, OfAnybodyNeedsNoHead) {
    EXPECT_EQ(sender_of("{\"robot\":\"a\",\"xyz\":[1,2,3]}\n"), "");
    EXPECT_EQ(sender_of("# from "), "");
    EXPECT_EQ(sender_of("# from a\r\n"), "a");
    EXPECT_EQ(poses_in("damaged\n\n{\"robot\":\"a\",\"xyz\":[1,2,3]}").size(), 1U);
}

TEST(Step, IsReadAsItWasWritten) {
    const std::string text = step_head(7, sim::Time(1'700'000'000'123'456'789), "my simulator") +
                             "{\"robot\":\"a\",\"xyz\":[1,2,3]}\n";
    const auto step = parse_step(text);
    ASSERT_TRUE(step);
    EXPECT_EQ(step->number, 7);
    EXPECT_EQ(step->time, sim::Time(1'700'000'000'123'456'789));
    EXPECT_EQ(step->from, "my simulator");
    EXPECT_EQ(poses_in(step->lines).size(), 1U);
    EXPECT_TRUE(parse_step("# step 1 t_ns -5 from a"));
    for (const char* bad : {"", "{}", "# step", "# step 1 from a", "# step x t_ns 1 from a",
                            "# step 1 t_ns 1 from ", "# step 99999999999 t_ns 1 from a"}) {
        EXPECT_FALSE(parse_step(bad)) << bad;
    }
}

TEST(Step, IsAcknowledgedToTheOneWhoLeads) {
    const std::string said = acknowledgement({.number = 7, .from = "my simulator"});
    EXPECT_EQ(acknowledged(said, "my simulator"), 7);
    EXPECT_FALSE(acknowledged(said, "another"));
    EXPECT_FALSE(acknowledged("", "another"));
}

TEST(Notes, AreReadAsTheyWereWritten) {
    const SceneNote scene{"0123456789abcdef", "east", 1.75e9};
    EXPECT_EQ(parse_scene_note(text_of(scene)), scene);
    const DaemonNote daemon{.name = "east",
                            .instance = "1a",
                            .lost = true,
                            .in_steps = true,
                            .host = "hub",
                            .sensors = 3,
                            .bodies = {{"tug", "cart"}, {"walker", ""}},
                            .trouble = "crate: no such file"};
    EXPECT_EQ(parse_daemon_note(text_of(daemon)), daemon);
}

TEST(Notes, OfOthersMayLackAnythingButTheirNames) {
    EXPECT_EQ(parse_daemon_note(R"({"name":"a"})"), DaemonNote{.name = "a"});
    EXPECT_EQ(parse_daemon_note(R"({"name":"a","robots":[1],"sensors":"x","state":3})"),
              DaemonNote{.name = "a"});
    for (const char* bad : {"", "[]", "{}", "{\"name\":3}", "{\"name\":"})
        EXPECT_FALSE(parse_daemon_note(bad)) << bad;
    for (const char* bad : {"", "7", "{}", "{\"hash\":1}"})
        EXPECT_FALSE(parse_scene_note(bad)) << bad;
}

AddModel whole() {
    AddModel edit;
    edit.placement = {.name = "crate",
                      .world_from_model = sim::Pose{{1.0, 2.0, 3.0}, {0.0, 0.0, 0.0, 1.0}},
                      .movable = false};
    edit.mesh = "crate.stl";
    edit.scale = 0.001;
    edit.material = "wood";
    return edit;
}

TEST(ModelMessage, IsTheBodyOfTheControlApi) {
    const auto edit = parse_model_message("crate", text_of(whole()));
    ASSERT_TRUE(edit) << edit.error().why;
    const auto& add = std::get<AddModel>(*edit);
    EXPECT_EQ(add.placement.name, "crate");
    EXPECT_EQ(add.placement.world_from_model, whole().placement.world_from_model);
    EXPECT_EQ(add.placement.movable, false);
    EXPECT_EQ(add.mesh, "crate.stl");
    EXPECT_EQ(add.scale, 0.001);
    EXPECT_EQ(add.material, "wood");
    EXPECT_TRUE(add.replace);
    EXPECT_EQ(text_of(add), text_of(whole()));
}

TEST(ModelMessage, TakesAwayOrIsRefused) {
    for (const std::string text : {"", R"({"remove":true})"}) {
        const auto edit = parse_model_message("crate", text);
        ASSERT_TRUE(edit);
        EXPECT_EQ(std::get<RemoveModel>(*edit).name, "crate");
    }
    EXPECT_THAT(parse_model_message("post", text_of(whole())).error().why,
                HasSubstr("name must be the one of the topic"));
    EXPECT_FALSE(parse_model_message("crate", "{}"));
    EXPECT_FALSE(parse_model_message("crate", "\xff"));
}

}  // namespace
}  // namespace scipd::daemon
