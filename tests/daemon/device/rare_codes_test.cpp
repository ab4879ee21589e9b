// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which codes a URG-04LX sends where it has no distance, against a recorded drive: 756 scans,
// 284 922 codes (simondlevy/BreezySLAM, examples/exp1). Seeds are fixed.
#include "daemon/device/rare_codes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/device/bridge.h"
#include "daemon/models/model_registry.h"
#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "sim/sensor/code_chance.h"
#include "sim/sensor/scanner.h"

namespace scipd::daemon {
namespace {

using enum sim::Cause;
using Wire = std::vector<std::uint32_t>;
using Shares = std::map<std::uint32_t, double>;

const protocol::DeviceProfile& urg() {
    return find_model("URG-04LX").profile;
}

/// As many readings of this cause, with chances or without.
std::vector<sim::Reading> gap(std::size_t beams, sim::Cause cause, std::uint64_t scan) {
    std::vector<sim::Reading> readings(beams, {.cause = cause});
    sim::draw_code_chances({.seed = 4, .sensor = 2, .scan = scan}, readings);
    return readings;
}

Wire sent(const std::vector<sim::Reading>& readings, const protocol::DeviceProfile& profile) {
    sim::Scan scan;
    scan.readings = readings;
    return to_wire(scan, {}, find_model("URG-04LX").optics, profile).distance;
}

Shares shares_of(const std::vector<Wire>& scans) {
    Shares shares;
    double all = 0.0;
    for (const Wire& scan : scans) {
        for (const std::uint32_t value : scan) {
            if (urg().is_distance(value)) continue;
            ++shares[value];
            ++all;
        }
    }
    for (auto& [code, share] : shares)
        share /= all;
    return shares;
}

std::vector<Wire> gaps(std::size_t beams, sim::Cause cause, int scans,
                       const protocol::DeviceProfile& profile = urg()) {
    std::vector<Wire> all;
    for (int scan = 0; scan < scans; ++scan)
        all.push_back(sent(gap(beams, cause, static_cast<std::uint64_t>(scan)), profile));
    return all;
}

TEST(RareCodes, StandByTheirSharesWhereNothingReturns) {
    for (const sim::Cause cause : {nothing, too_dark}) {
        const Shares shares = shares_of(gaps(682, cause, 2000));
        // Five standard errors; those of 6, 1 and 2 come in fours.
        const auto expect = [&](std::uint32_t code, double share) {
            EXPECT_NEAR(shares.at(code), share, 5 * std::sqrt(4 * share / (682 * 2000.0))) << code;
        };
        expect(7, 0.0178);
        expect(6, 0.0150);
        expect(1, 0.0047);
        expect(2, 0.0014);
        EXPECT_NEAR(shares.at(0), 0.959, 0.005);
        EXPECT_FALSE(shares.contains(9));
        EXPECT_FALSE(shares.contains(18));
    }
}

TEST(RareCodes, AreOftenSevenBesideADistance) {
    constexpr int scans = 4000;
    std::vector<Wire> ends;
    for (int scan = 0; scan < scans; ++scan) {
        auto readings = gap(40, nothing, static_cast<std::uint64_t>(scan));
        for (const std::size_t end : {0U, 39U})
            readings[end] = {.range_m = 1.0F, .cause = measured};
        const Wire wire = sent(readings, urg());
        ends.push_back({wire[1], wire[38]});
    }
    const Shares shares = shares_of(ends);
    EXPECT_NEAR(shares.at(7), 0.137, 5 * std::sqrt(0.137 / (2.0 * scans)));
    EXPECT_NEAR(shares.at(10), 0.0101, 5 * std::sqrt(0.0101 / (2.0 * scans)));
}

TEST(RareCodes, AreSevenAtAnEdge) {
    std::vector<Wire> edges;
    for (int scan = 0; scan < 4000; ++scan) {
        auto readings = gap(3, edge, static_cast<std::uint64_t>(scan));
        for (const std::size_t end : {0U, 2U})
            readings[end] = {.range_m = 1.0F, .cause = measured};
        edges.push_back(sent(readings, urg()));
    }
    const Shares shares = shares_of(edges);
    EXPECT_NEAR(shares.at(7), 0.85, 0.03);
    EXPECT_NEAR(shares.at(10), 0.064, 0.02);
    EXPECT_FALSE(shares.contains(0));
}

// The recorded drive has 7541 times 7, never two side by side; 78 % of all 6 have another one
// behind them.
TEST(RareCodes, StandAloneOrInRuns) {
    double sixes = 0.0;
    double followed = 0.0;
    for (const sim::Cause cause : {nothing, edge}) {
        for (const Wire& scan : gaps(682, cause, 400)) {
            for (std::size_t beam = 1; beam < scan.size(); ++beam) {
                EXPECT_FALSE(scan[beam] == 7 && scan[beam - 1] == 7);
                if (cause == edge) continue;
                sixes += scan[beam - 1] == 6 ? 1 : 0;
                followed += scan[beam - 1] == 6 && scan[beam] == 6 ? 1 : 0;
            }
        }
    }
    EXPECT_NEAR(followed / sixes, 0.78, 0.08);
}

TEST(RareCodes, AreLeftToChanceAlone) {
    const std::vector<sim::Reading> ideal(682, {.cause = too_dark});
    EXPECT_EQ(sent(ideal, urg()), Wire(682, 0));
    EXPECT_EQ(gaps(682, nothing, 3), gaps(682, nothing, 3));
    EXPECT_NE(gaps(682, nothing, 1), gaps(682, too_bright, 1));
    EXPECT_EQ(sent(gap(682, too_bright, 1), urg()), Wire(682, 18));
    EXPECT_EQ(sent(gap(682, lost, 1), urg()), Wire(682, 9));
    protocol::DeviceProfile plain = urg();
    plain.rare_codes = {};
    EXPECT_EQ(sent(gap(682, nothing, 1), plain), Wire(682, 0));
}

/// The office with black shelves along the corridor and in two rooms, which are too dark for a URG
/// but from near by. So its scans are like those of the drive: the gaps are wide, and one code in
/// 16 is beside a distance.
sim::SharedScene office() {
    auto scene = std::make_shared<sim::Scene>(
        *sim::load_scene(std::filesystem::path(SCIPD_SCENES) / "office_map.yaml").scene);
    const auto black = static_cast<sim::MaterialId>(scene->materials.size());
    scene->materials.push_back({"black"});
    const auto add = [&](const glm::dvec3& at_m, const glm::dvec3& size_m) {
        const auto model = static_cast<sim::ModelId>(scene->models.size());
        scene->models.push_back({"shelf", false, sim::pose_from_rpy(at_m, {0, 0, 0})});
        scene->objects.push_back({"shelf", model, {}, sim::Box{size_m}, black});
    };
    add({9.5, 3.95, 0.5}, {4.6, 0.3, 1.0});
    add({4.5, 5.05, 0.5}, {4.0, 0.3, 1.0});
    add({14.9, 4.7, 0.5}, {0.2, 0.9, 1.0});
    add({2.5, 8.7, 0.5}, {4.0, 0.4, 1.0});
    add({7.5, 0.3, 0.5}, {4.0, 0.4, 1.0});
    return scene;
}

/// The share of the codes that are beside a distance.
double share_beside(const std::vector<Wire>& scans) {
    double codes = 0.0;
    double beside = 0.0;
    for (const Wire& scan : scans) {
        for (std::size_t beam = 1; beam + 1 < scan.size(); ++beam) {
            if (urg().is_distance(scan[beam])) continue;
            ++codes;
            if (urg().is_distance(scan[beam - 1]) || urg().is_distance(scan[beam + 1])) ++beside;
        }
    }
    return beside / codes;
}

/// Scans of a drive through the office, at `material`.
std::vector<Wire> office_drive(const Model& model, int scans) {
    const sim::SharedScene scene = office();
    std::vector<sim::Surface> surfaces(scene->materials.size(), {.diffuse = 0.5F});
    surfaces.back() = {.diffuse = 0.024F};
    const sim::LitWorld lit(surfaces, {});
    const auto backend = sim::make_backend("embree", scene);
    const sim::Scanner scanner(
        model.optics,
        {.accuracy = sim::Accuracy::material, .seed = 5, .sensor = 8, .codes_vary = true});
    std::vector<Wire> drive;
    for (int i = 0; i < scans; ++i) {
        const double way = double(i) / scans;
        const sim::Pose pose = sim::pose_from_rpy(
            {1.0 + 12.0 * way, 4.5 + 0.2 * std::sin(9 * way), 0.25}, {0, 0, 12 * way});
        const auto scan = scanner.measure(*backend, i, {}, {pose}, {.lit = &lit});
        drive.push_back(to_wire(*scan, {}, model.optics, model.profile).distance);
    }
    return drive;
}

TEST(RareCodes, OfAnOfficeAreThoseOfARecordedDrive) {
    // By their shares; 15 and 8 are too rare for their order to be sure.
    const std::vector<std::pair<std::uint32_t, double>> recorded = {
        {0, 0.9495},  {7, 0.0265}, {6, 0.0149}, {1, 0.0046},
        {10, 0.0015}, {2, 0.0014}, {8, 0.0009}, {15, 0.0006}};
    const std::vector<Wire> drive = office_drive(find_model("URG-04LX"), 756);
    ASSERT_NEAR(share_beside(drive), 1.0 / 16.0, 0.02);
    const Shares shares = shares_of(drive);
    for (const auto& [code, share] : shares)
        RecordProperty("code_" + std::to_string(code), std::to_string(share));
    EXPECT_EQ(shares.size(), recorded.size());
    for (const auto& [code, share] : recorded) {
        ASSERT_TRUE(shares.contains(code)) << code;
        EXPECT_GT(shares.at(code), share / 2) << code;
        EXPECT_LT(shares.at(code), share * 2) << code;
    }
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_GT(shares.at(recorded[i - 1].first), shares.at(recorded[i].first));
}

}  // namespace
}  // namespace scipd::daemon
