// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The noise of each family, against what public recordings of standing scanners show of walls at
// the same ranges and incidences. docs/errors.md has the figures side by side.
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "tests/daemon/models/cast_by_hand.h"

namespace scipd::daemon {
namespace {

constexpr int scans = 600;

/// What neighbouring beams on one wall have in common.
struct Noise {
    double sd_mm = 0.0;
    double next = 0.0;   ///< correlation with the next beam
    double after = 0.0;  ///< and with the one after
    /// The variance of the mean of five neighbours, as a multiple of that of independent ones.
    double of_five = 0.0;
    double equal = 0.0;  ///< share of neighbours that read the same millimetre
};

using Distances = std::vector<std::vector<double>>;  ///< by scan and beam, mm

Distances distances_mm(const FlatWall& wall, const sim::SensorSpec& optics, const How& how = {}) {
    Distances distances;
    for (int revolution = 0; revolution < scans; ++revolution) {
        std::vector<double>& of_scan = distances.emplace_back();
        for (const sim::Reading& reading : scan_of(wall, optics, revolution, how).readings)
            of_scan.push_back(std::round(1000.0 * double{reading.range_m}));
    }
    return distances;
}

/// The noise of the eleven middle beams.
Noise noise_of(const Distances& distances_mm) {
    const std::size_t beams = distances_mm.front().size();
    std::vector<double> mean_mm(beams);
    for (const auto& scan : distances_mm) {
        for (std::size_t beam = 0; beam < beams; ++beam)
            mean_mm[beam] += scan[beam] / scans;
    }
    Noise sum;
    double fives = 0.0;
    for (const auto& scan : distances_mm) {
        const auto off = [&](std::size_t beam) { return scan[beam] - mean_mm[beam]; };
        for (std::size_t beam = beams / 2 - 5; beam <= beams / 2 + 5; ++beam) {
            sum.sd_mm += off(beam) * off(beam);
            sum.next += off(beam) * off(beam + 1);
            sum.after += off(beam) * off(beam + 2);
            sum.equal += scan[beam] == scan[beam + 1] ? 1.0 : 0.0;
            const double five =
                off(beam - 2) + off(beam - 1) + off(beam) + off(beam + 1) + off(beam + 2);
            fives += five * five / 5.0;
        }
    }
    constexpr double count = 11.0 * scans;
    return {std::sqrt(sum.sd_mm / count), sum.next / sum.sd_mm, sum.after / sum.sd_mm,
            fives / sum.sd_mm, sum.equal / count};
}

struct Recorded {
    const char* model;
    double range_m;
    double incidence_deg;
    double sd_mm;
    float reflectance = 1.0F;
};

void PrintTo(const Recorded& recorded, std::ostream* out) {
    *out << recorded.model << " at " << recorded.range_m << " m, " << recorded.incidence_deg
         << " degrees";
}

/// Four UST in a room (SkoltechRobotics/Eurobot2018), a UTM-30LX (yogeshgajjar/cartographer_data),
/// the front URG-04LX of a pair (tysik/obstacle_detector), a URG-04LX before a white wall
/// (srLarsons/FaultModeling-for-2D-Laser-scanner) and a UHG-08LX (angusleigh/leg_tracker). The
/// incidences of rooms are those of most of their walls at that range. The last wall of the URG in
/// a room has to be darker than white: the white one at 3.05 m sends back as little light.
constexpr Recorded deviations[] = {
    {"UST-10LX", 0.7, 20, 4.7},  {"UST-10LX", 1.4, 20, 5.8},       {"UST-10LX", 2.2, 20, 6.0},
    {"UST-10LX", 3.3, 20, 6.8},  {"UST-10LX", 5.0, 20, 6.5},       {"UTM-30LX", 2.33, 10, 4.0},
    {"UTM-30LX", 2.85, 38, 5.5}, {"UTM-30LX", 5.0, 20, 4.9},       {"URG-04LX", 2.29, 4, 3.1},
    {"URG-04LX", 3.15, 26, 5.1}, {"URG-04LX", 4.8, 30, 9.2, 0.5F}, {"URG-04LX", 0.22, 0, 2.7},
    {"URG-04LX", 0.52, 0, 2.9},  {"URG-04LX", 1.02, 0, 3.7},       {"URG-04LX", 1.45, 45, 4.7},
    {"URG-04LX", 2.06, 60, 4.3}, {"URG-04LX", 3.05, 70, 6.5},      {"URG-04LX", 3.9, 75, 11.0},
    {"UHG-08LX", 0.4, 10, 4.4},  {"UHG-08LX", 6.5, 20, 6.8},
};

class Deviation : public testing::TestWithParam<Recorded> {};

TEST_P(Deviation, IsThatOfARecordedWall) {
    const auto& [model, range_m, incidence_deg, sd_mm, reflectance] = GetParam();
    const FlatWall wall{range_m, incidence_deg * degree};
    const sim::SensorSpec& optics = find_model(model).optics;
    const How lit{sim::Accuracy::material, {.diffuse = reflectance}};
    const double material_mm = noise_of(distances_mm(wall, optics, lit)).sd_mm;
    EXPECT_NEAR(material_mm, sd_mm, 0.25 * sd_mm);
    RecordProperty("material_mm", std::to_string(material_mm));
    // There all faces are white, and met head-on.
    if (reflectance < 1.0F || incidence_deg > 45.0) return;
    const double sensor_mm = noise_of(distances_mm(wall, optics)).sd_mm;
    EXPECT_NEAR(sensor_mm, sd_mm, 0.25 * sd_mm);
    RecordProperty("sensor_mm", std::to_string(sensor_mm));
}

INSTANTIATE_TEST_SUITE_P(Of, Deviation, testing::ValuesIn(deviations));

struct Neighbours {
    const char* model;
    double range_m;
    double incidence_deg;
    Noise noise;
};

void PrintTo(const Neighbours& recorded, std::ostream* out) {
    *out << recorded.model << " at " << recorded.range_m << " m, " << recorded.incidence_deg
         << " degrees";
}

/// Means over those beams of the same recordings whose ten neighbours lie on one wall: 132, 85, 15,
/// 13, 39 and 29 of them. The other walls of the UST share more nearer by, 0.57 and 0.23.
constexpr Neighbours shares[] = {
    {"UST-10LX", 3.15, 18, {5.3, 0.40, 0.10, 1.75, 0.10}},
    {"UTM-30LX", 2.33, 10, {3.7, 0.66, 0.40, 2.71, 0.36}},
    {"UTM-30LX", 2.43, 35, {5.2, 0.37, 0.10, 1.72, 0.05}},
    {"UTM-30LX", 2.85, 38, {5.5, 0.30, 0.05, 1.46, 0.03}},
    {"URG-04LX", 2.29, 4, {2.4, 0.64, 0.40, 2.73, 0.45}},
    {"URG-04LX", 3.15, 26, {4.5, 0.23, 0.05, 1.44, 0.04}},
};

class NeighbouringBeams : public testing::TestWithParam<Neighbours> {};

TEST_P(NeighbouringBeams, ShareNoiseAsOnARecordedWall) {
    const auto& [model, range_m, incidence_deg, recorded] = GetParam();
    const FlatWall wall{range_m, incidence_deg * degree};
    const Noise noise = noise_of(distances_mm(wall, find_model(model).optics));
    EXPECT_NEAR(noise.sd_mm, recorded.sd_mm, 0.25 * recorded.sd_mm);
    EXPECT_NEAR(noise.next, recorded.next, 0.1);
    EXPECT_NEAR(noise.after, recorded.after, 0.1);
    EXPECT_NEAR(noise.of_five, recorded.of_five, 0.25 * recorded.of_five);
    EXPECT_GT(noise.equal, 0.5 * recorded.equal);
    EXPECT_LT(noise.equal, 2.0 * recorded.equal);
}

INSTANTIATE_TEST_SUITE_P(Of, NeighbouringBeams, testing::ValuesIn(shares));

// 11 % of a UST's neighbours on smooth walls are equal, 23 to 37 % of others'.
TEST(EqualNeighbours, AreAsManyAsOnSmoothWalls) {
    const auto share = [](const char* model, double range_m) {
        return noise_of(distances_mm({range_m, 0.0}, find_model(model).optics)).equal;
    };
    EXPECT_NEAR(share("UST-10LX", 1.0), 0.11, 0.04);
    EXPECT_GT(share("UTM-30LX", 2.0), 0.23);
    EXPECT_GT(share("URG-04LX", 1.0), 0.23);
    EXPECT_GT(share("UHG-08LX", 1.0), 0.23);
    EXPECT_GT(share("UXM-30LX-E", 2.0), 0.23);
}

class Sample {
  public:
    void add(double number) {
        sum_ += number;
        squares_ += number * number;
        ++count_;
    }
    [[nodiscard]] double mean() const { return sum_ / count_; }
    [[nodiscard]] double deviation() const {
        return std::sqrt(squares_ / count_ - mean() * mean());
    }

  private:
    double sum_ = 0.0;
    double squares_ = 0.0;
    int count_ = 0;
};

struct ByLight {
    double intensity;
    double least_mm;
    double most_mm;
    double flicker;  ///< the deviation of the intensity, as a share
};

/// Over four recorded UST; the last one a retro-reflector.
constexpr ByLight by_light[] = {{275, 13.6, 16.5, 0.035}, {425, 9.5, 11.8, 0.018},
                                {600, 7.4, 8.5, 0.013},   {850, 5.7, 6.7, 0.008},
                                {1250, 4.6, 6.5, 0.013},  {4000, 4.1, 5.7, 0.035}};

TEST(UstNoise, FollowsTheIntensity) {
    const sim::SensorSpec& optics = find_model("UST-10LX").optics;
    constexpr double range_m = 1.5;
    for (const auto& [intensity, least_mm, most_mm, flicker] : by_light) {
        // Above white the intensity grows with the logarithm.
        const double whites = intensity / optics.intensity(range_m, 1.0);
        const double log_gain = optics.receiver.log_gain;
        const auto reflectance =
            static_cast<float>(whites <= 1.0 ? whites : std::exp((whites - 1.0) / log_gain));
        const How lit{sim::Accuracy::material, {.diffuse = reflectance}, 2};
        Sample light;
        Sample ranges_m;
        for (int revolution = 0; revolution < scans; ++revolution) {
            const sim::Scan scan = scan_of(FlatWall{range_m}, optics, revolution, lit);
            light.add(scan.readings[2].intensity);
            ranges_m.add(scan.readings[2].range_m);
        }
        EXPECT_NEAR(light.mean(), intensity, 0.02 * intensity);
        EXPECT_NEAR(light.deviation() / light.mean(), flicker, 0.25 * flicker) << intensity;
        const double sd_mm = 1000.0 * ranges_m.deviation();
        EXPECT_GT(sd_mm, 0.9 * least_mm) << intensity;
        EXPECT_LT(sd_mm, 1.1 * most_mm) << intensity;
    }
}

// There is one figure of a UHG-08LX, over the walls of a room, which it meets at some angle: the
// mean of five neighbours has 1.43 times the variance of independent ones.
TEST(UhgNoise, IsSharedByFiveNeighboursAsInARoom) {
    const sim::SensorSpec& optics = find_model("UHG-08LX").optics;
    const Noise noise = noise_of(distances_mm({3.0, 25.0 * degree}, optics));
    EXPECT_NEAR(noise.of_five, 1.43, 0.25 * 1.43);
    RecordProperty("of_five", std::to_string(noise.of_five));
}

// A scan of a UXM-30LX-E, of which one is recorded: the second difference of neighbours has 2.4 mm
// times the square root of six.
TEST(UxmNoise, DiffersLittleFromOneBeamToTheNext) {
    double squares_mm2 = 0.0;
    double count = 0.0;
    for (const auto& scan : distances_mm({2.0, 0.0}, find_model("UXM-30LX-E").optics)) {
        for (std::size_t beam = 10; beam + 10 < scan.size(); ++beam) {
            const double second_mm = scan[beam - 1] - 2.0 * scan[beam] + scan[beam + 1];
            squares_mm2 += second_mm * second_mm;
            ++count;
        }
    }
    const double of_one_mm = std::sqrt(squares_mm2 / count / 6.0);
    EXPECT_NEAR(of_one_mm, 2.4, 0.25 * 2.4);
    RecordProperty("of_one_mm", std::to_string(of_one_mm));
}

}  // namespace
}  // namespace scipd::daemon
