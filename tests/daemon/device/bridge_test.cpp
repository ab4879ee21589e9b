// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/bridge.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Expected {
    const char* model;
    std::vector<std::pair<float, std::uint32_t>> distances;
};

// Data sheets and the specification's tables of codes.
const std::vector<Expected> all_models = {
    {"UST-10LX", {{0.0F, 4}, {0.0204F, 4}, {0.0206F, 21}, {30.0004F, 30000}, {30.0006F, 65533}}},
    {"UST-20LX", {{0.0204F, 4}, {0.0206F, 21}, {60.0F, 60000}, {60.001F, 65533}}},
    {"UTM-30LX", {{0.0224F, 2}, {0.0226F, 23}, {60.0F, 60000}, {60.001F, 1}}},
    {"URG-04LX", {{0.0194F, 10}, {0.0196F, 20}, {5.6F, 5600}, {5.601F, 0}}},
};

TEST(Bridge, RoundsToMillimetresAndTellsCodes) {
    for (const auto& [model, distances] : all_models) {
        const protocol::DeviceProfile& profile = find_model(model).profile;
        for (const auto& [range_m, distance] : distances)
            EXPECT_EQ(distance_on_wire(range_m, profile), distance) << model << " " << range_m;
        EXPECT_EQ(distance_on_wire(1.0004F, profile), 1000U);
        EXPECT_EQ(distance_on_wire(1.0006F, profile), 1001U);
        // Noise may make a range negative.
        EXPECT_EQ(distance_on_wire(-0.5F, profile), profile.codes.too_near);
    }
}

TEST(Bridge, TellsWhatDidNotReturn) {
    EXPECT_EQ(distance_on_wire(infinity, find_model("UST-10LX").profile), 65533U);
    EXPECT_EQ(distance_on_wire(infinity, find_model("UTM-30LX").profile), 1U);
    EXPECT_EQ(distance_on_wire(infinity, find_model("URG-04LX").profile), 0U);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(distance_on_wire(nan, find_model("URG-04LX").profile), 0U);
}

TEST(Bridge, TurnsAScanIntoTheWordsOfTheWire) {
    const Model& model = find_model("URG-04LX");
    sim::Scan scan;
    scan.start = 350ms;
    using enum sim::Cause;
    scan.readings = {{2.001F, 0.25F, 2500.4F, measured}, {0.999F, 0.5F, 5000.0F, measured},
                     {0.1F, 4.0F, 300'000.0F, measured}, {infinity, 0.0F, 0.0F, nothing},
                     {infinity, 0.0F, 0.0F, too_dark},   {infinity, 900.0F, 70.0F, too_bright},
                     {infinity, 0.0F, 0.0F, edge},       {infinity, 0.0F, 0.0F, lost}};

    const WireScan wire = to_wire(scan, {.start = 300ms}, model.optics, model.profile);
    EXPECT_EQ(wire.turn.start, 300ms);
    EXPECT_EQ(wire.first_step, 44);
    EXPECT_EQ(wire.distance, (std::vector<std::uint32_t>{2001, 999, 100, 0, 0, 18, 7, 9}));
    EXPECT_EQ(wire.intensity, (std::vector<std::uint32_t>{2500, 5000, 262143, 0, 0, 70, 0, 0}));
    EXPECT_TRUE(wire.echoes.empty());

    const protocol::ScanView view = wire.view();
    EXPECT_EQ(view.turn.start, 300ms);
    EXPECT_EQ(view.first_step, 44);
    EXPECT_EQ(view.distance.data(), wire.distance.data());
    EXPECT_EQ(view.intensity.size(), 8U);
}

TEST(Bridge, TellsEveryEchoOfScannersThatDo) {
    const Model& model = find_model("UTM-30LX-EW");
    sim::Scan scan;
    using enum sim::Cause;
    scan.readings = {{3.0F, 1.0F, 900.0F, measured}, {infinity, 0.0F, 0.0F, too_dark}};
    scan.every_echo.add({1.5F, 0.5F, 400.0F, measured});
    scan.every_echo.add({3.0F, 1.0F, 900.0F, measured});
    scan.every_echo.finish_beam();
    scan.every_echo.add(scan.readings[1]);
    scan.every_echo.finish_beam();
    const WireScan wire = to_wire(scan, {}, model.optics, model.profile);
    ASSERT_EQ(wire.view().echoes.size(), 2U);
    EXPECT_EQ(wire.echoes[0].count, 2);
    EXPECT_EQ(wire.echoes[0].echo[0].distance, 1500U);
    EXPECT_EQ(wire.echoes[0].echo[0].intensity, 400U);
    EXPECT_EQ(wire.echoes[0].echo[1].distance, 3000U);
    EXPECT_EQ(wire.echoes[1].count, 1);
    EXPECT_EQ(wire.echoes[1].echo[0].distance, 1U);
    EXPECT_EQ(wire.distance, (std::vector<std::uint32_t>{3000, 1}));
}

}  // namespace
}  // namespace scipd::daemon
