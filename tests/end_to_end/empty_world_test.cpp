// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An empty world that is filled and emptied while a scanner runs, with every backend.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/backend_names.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

constexpr std::size_t ahead = 540;

std::vector<std::string> auto_and_all() {
    std::vector<std::string> names = backend_names();
    names.emplace_back("auto");
    return names;
}

class EmptyWorld : public testing::TestWithParam<std::string> {
  protected:
    /// Waits until the beam that looks ahead has this range.
    static bool comes_to(const DaemonProcess& daemon, ScannerWire& wire,
                         const std::optional<double>& range_m) {
        return eventually([&] {
            (void)wire.next_scan();
            const auto range = daemon.get("/sensors/robot/scanner/truth").at("true_m").at(ahead);
            if (!range_m) return range.is_null();
            return range.is_number() && std::abs(range.get<double>() - *range_m) < 0.001;
        });
    }
    static int ask(const DaemonProcess& daemon, const std::string& method, const std::string& path,
                   const nlohmann::json& body = nullptr) {
        return control_request(daemon.control(), method, path, body.is_null() ? "" : body.dump())
            .status;
    }
};

TEST_P(EmptyWorld, IsFilledAndEmptied) {
    const std::string backend = GetParam();
    const bool draws = backend == sim::drawing_backend().name;
    if (draws && !can_draw()) GTEST_SKIP() << "nothing can be drawn here";
    const TempDir directory;
    const std::string nothing =
        directory.write("nothing.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
    const std::string room = directory.path() / "room.sdf";
    std::filesystem::copy_file(scene("square_room.sdf"), room);
    const DaemonProcess daemon(directory, {"--scene", nothing, "--backend", backend, "--accuracy",
                                           "ideal", "--tcp", "127.0.0.1:0"});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    auto wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask(stream_of_one_beam), "00");
    const nlohmann::json cube{
        {"name", "cube"},
        {"sdf",
         "<model name='m'><link name='l'><visual name='v'><geometry><box><size>0.5 0.5 0.5</size>"
         "</box></geometry></visual></link></model>"},
        {"pose", {{"xyz", {2.0, 0.0, 0.0}}}}};
    for (int round = 0; round < 2; ++round) {
        EXPECT_TRUE(comes_to(daemon, wire, std::nullopt));
        EXPECT_EQ(ask(daemon, "POST", "/scene/models", cube), 201);
        EXPECT_TRUE(comes_to(daemon, wire, 1.75));
        EXPECT_EQ(ask(daemon, "PUT", "/scene/models/cube/pose", {{"xyz", {3.0, 0.0, 0.0}}}), 204);
        EXPECT_TRUE(comes_to(daemon, wire, 2.75));
        EXPECT_EQ(ask(daemon, "DELETE", "/scene/models/cube"), 204);
    }
    EXPECT_TRUE(comes_to(daemon, wire, std::nullopt));
    EXPECT_EQ(ask(daemon, "PUT", "/scene", {{"file", room}}), 200);
    EXPECT_TRUE(comes_to(daemon, wire, 3.0));
    EXPECT_EQ(ask(daemon, "PUT", "/scene", {{"file", nothing}}), 200);
    EXPECT_TRUE(comes_to(daemon, wire, std::nullopt));
    EXPECT_EQ(daemon.sensor_status().at("lost"), 0);
}

INSTANTIATE_TEST_SUITE_P(ByBackend, EmptyWorld, testing::ValuesIn(auto_and_all()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace scipd::tests
