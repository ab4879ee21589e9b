// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tests what scipd tells the user about the choice of `auto`: at the start, when it has measured
// the backends, and in lockstep.
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

std::string reason(const DaemonProcess& daemon) {
    return daemon.sensor_status().at("backend_reason").get<std::string>();
}

TEST(BackendChoice, IsMeasuredSoonAfterTheStartAndTold) {
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tty({}));
    ASSERT_TRUE(eventually([&] { return reason(daemon) != "not measured yet"; }));
    const std::string told = reason(daemon);
    EXPECT_THAT(told, AnyOf(HasSubstr(" ms per scan"), HasSubstr("no depth: ")));
    EXPECT_TRUE(
        eventually([&] { return daemon.standard_error().find(told) != std::string::npos; }));

    auto wire = ScannerWire::tty(daemon.tty());
    ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
    (void)wire.next_scan();
    const auto truth = daemon.get("/sensors/robot/scanner/truth");
    EXPECT_EQ(truth.at("backend"), daemon.sensor_status().at("backend"));
    EXPECT_EQ(truth.at("backend_reason"), told);
}

// A trial beside it would make its first scans late.
TEST(BackendChoice, IsMeasuredOnceNoClientIsThere) {
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tty({}));
    {
        auto wire = ScannerWire::tty(daemon.tty());
        ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
        for (int scan = 0; scan < 100; ++scan)
            (void)wire.next_scan();
        EXPECT_EQ(reason(daemon), "not measured yet");
    }
    EXPECT_TRUE(eventually([&] { return reason(daemon) != "not measured yet"; }));
}

TEST(BackendChoice, IsNotMeasuredWhereOneIsAskedForByName) {
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tty({"--backend", "reference"}));
    EXPECT_EQ(daemon.sensor_status().at("backend"), "reference");
    EXPECT_TRUE(daemon.sensor_status().at("backend_reason").is_null());
}

TEST(BackendChoice, IsRaysInLockstepSoThatTwoRunsAreTheSame) {
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tty({"--clock", "poses", "--poses", "-"}));
    EXPECT_EQ(daemon.sensor_status().at("backend"), "embree");
    EXPECT_THAT(reason(daemon), HasSubstr("lockstep"));
}

// A scene is loaded on another thread while the old one runs. The new scene must be able to draw.
TEST(BackendChoice, ADepthBufferSeesAModelThatIsAdded) {
    if (!can_draw()) GTEST_SKIP() << "nothing can be drawn here; see scipd --probe";
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tty({"--backend", "depth", "--accuracy", "ideal"}));
    auto wire = ScannerWire::tty(daemon.tty());
    ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
    (void)wire.next_scan();
    for (const std::string name : {"first", "second", "third"}) {
        const std::string box =
            "<model name='x'><link name='l'><visual name='v'><geometry>"
            "<box><size>0.2 0.2 2</size></box></geometry></visual></link></model>";
        const nlohmann::json body{
            {"name", name}, {"sdf", box}, {"pose", {{"xyz", {1.0, 0.0, 0.0}}}}};
        const auto answer = control_request(daemon.control(), "POST", "/scene/models", body.dump());
        ASSERT_EQ(answer.status, 201) << answer.body;
        EXPECT_TRUE(eventually([&] {
            (void)wire.next_scan();
            const auto truth = daemon.get("/sensors/robot/scanner/truth");
            return truth.at("object").dump().find(name) != std::string::npos;
        })) << name;
        const auto gone = control_request(daemon.control(), "DELETE", "/scene/models/" + name);
        ASSERT_EQ(gone.status, 204) << gone.body;
    }
}

}  // namespace
}  // namespace scipd::tests
