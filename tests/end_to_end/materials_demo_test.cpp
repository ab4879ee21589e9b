// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world that shows what materials do, as its users run it. Its first comment has the ranges.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/support/control_request.h"
#include "tests/support/daemon_process.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Both scanners have 1081 steps of a quarter of a degree, and look ahead at 540.
std::size_t step_at(int bearing_deg) {
    return static_cast<std::size_t>(540 + 4 * bearing_deg);
}

class MaterialsDemo : public testing::Test {
  protected:
    std::string config(const std::string& accuracy) {
        std::ifstream shipped{scene("materials_demo.yaml")};
        std::string text{std::istreambuf_iterator<char>{shipped}, {}};
        replace_all(text, ":10940", ":0");
        replace_all(text, ":10941", ":0");
        replace_all(text, "scene: ", "scene: " + scene("").string() + "/");
        replace_all(text, "accuracy: material", "accuracy: " + accuracy);
        return directory_.write("demo.yaml", text);
    }
    [[nodiscard]] static std::string target(const DaemonProcess& daemon) {
        return "tcp://127.0.0.1:" + std::to_string(daemon.port());
    }

    TempDir directory_;
};

TEST_F(MaterialsDemo, StandsWhereItsCommentSays) {
    const DaemonProcess daemon(directory_, {"--config", config("ideal")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    EXPECT_THAT(daemon.standard_error(), Not(HasSubstr("warning")));
    for (const std::size_t sensor : {0U, 1U}) {
        ScannerWire wire = ScannerWire::tcp(daemon.port(sensor));
        ASSERT_EQ(wire.ask("MD0000108000001"), "00");
        const auto distances = wire.next_scan().distances_mm;
        for (const int bearing_deg : {-60, -48, -36, -24, -12, 12, 24, 36, 48, 60, 90, -90}) {
            for (const int beside : {-8, 0, 8}) {
                const double across_rad = beside / 4.0 * M_PI / 180.0;
                // The mirror is at 45 degrees: it is met at x + y = -3.
                const double range_mm = bearing_deg == -90
                                            ? 3000.0 / (std::cos(across_rad) - std::sin(across_rad))
                                            : 3000.0 / std::cos(across_rad);
                EXPECT_NEAR(distances[step_at(bearing_deg) + static_cast<std::size_t>(beside)],
                            range_mm, 1.0)
                    << bearing_deg << " " << beside;
            }
        }
        EXPECT_EQ(distances[step_at(0)], 8000U);
        EXPECT_EQ(distances[step_at(120)], 2998U);
    }
}

// The UTM-30LX-EW errs by up to 23 mm, and by noise of 10 mm.
TEST_F(MaterialsDemo, ShowsAWallThroughGlassAsTheSecondEcho) {
    const DaemonProcess daemon(directory_, {"--config", config("material")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    ASSERT_EQ(wire.ask("ND0000108000001"), "00");
    const auto scan = wire.next_scan();
    const std::size_t door = step_at(90);
    EXPECT_NEAR(scan.distances_mm[door], 3000.0, 80.0);
    ASSERT_EQ(scan.further_echoes[door].size(), 1U);
    EXPECT_NEAR(scan.further_echoes[door][0].distance_mm, 5000.0, 80.0);
    // In the mirror it sees the box that the row hides.
    EXPECT_NEAR(scan.distances_mm[step_at(-90)], 5700.0, 80.0);
}

TEST_F(MaterialsDemo, DependsOnWhatThePanelsAreMadeOf) {
    const DaemonProcess daemon(directory_, {"--config", config("material")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    for (const std::size_t sensor : {0U, 1U}) {
        ScannerWire wire = ScannerWire::tcp(daemon.port(sensor));
        ASSERT_EQ(wire.ask("MD0000108000001"), "00");
        const auto scan = wire.next_scan();
        const auto truth =
            daemon.get(sensor == 0 ? "/sensors/robot/multi/truth" : "/sensors/robot/single/truth");
        ASSERT_EQ(truth.at("stamp_ms"), scan.stamp_ms);
        EXPECT_EQ(truth.at("accuracy"), "material");
        // 2.4 % of reflectance, 8 m away.
        EXPECT_EQ(truth.at("material").at(step_at(0)), "black_foam");
        EXPECT_THAT(truth.at("cause").at(step_at(0)), AnyOf("too_dark", "nothing"));
        EXPECT_EQ(scan.distances_mm[step_at(0)], sensor == 0 ? 1U : 65533U);
        // A UST-10LX sees a tenth of reflectance up to 4 m, and so 2.4 % up to 2 m.
        EXPECT_EQ(truth.at("cause").at(step_at(-36)), sensor == 0 ? "measured" : "too_dark");
        EXPECT_EQ(truth.at("cause").at(step_at(60)), "measured");
        const auto& intensity = truth.at("intensity");
        EXPECT_GT(intensity.at(step_at(60)), intensity.at(step_at(-12)));
        const int tape = intensity.at(step_at(120));
        EXPECT_GT(tape, 3 * intensity.at(step_at(118)).get<int>());
    }
}

/// What the middle of the beam met, or of the echoes that came back the nearest to what was sent.
double seen_mm(const nlohmann::json& truth, std::size_t step, bool by_middle) {
    const double sent_mm = truth["sent_mm"][step];
    std::vector<double> echoes_mm;
    if (!by_middle) {
        for (const nlohmann::json& echo : truth["echoes"][step])
            echoes_mm.push_back(1e3 * echo["range_m"].get<double>());
    }
    if (echoes_mm.empty()) return 1e3 * truth["true_m"][step].get<double>();
    return *std::ranges::min_element(echoes_mm, {},
                                     [&](double range_mm) { return std::abs(range_mm - sent_mm); });
}

/// How much too far each step reads that reads anything.
std::vector<double> errors_mm(const nlohmann::json& truth, bool by_middle) {
    std::vector<double> errors;
    for (std::size_t step = 0; step < truth["steps"].size(); ++step) {
        const double sent_mm = truth["sent_mm"][step];
        if (sent_mm >= 23.0) errors.push_back(sent_mm - seen_mm(truth, step, by_middle));
    }
    return errors;
}

/// As many points are too far as the truth has behind the end of the scale, but not the walls that
/// are seen rightly through glass.
void expect_colours_of_what_returned(const std::string& file, const nlohmann::json& truth) {
    std::ifstream stream{file};
    const std::string svg{std::istreambuf_iterator<char>{stream}, {}};
    std::smatch most;
    ASSERT_TRUE(std::regex_search(svg, most, std::regex(R"(>\+(\d+)<)")));
    const double most_mm = std::stod(most[1]);
    const auto beyond = [&](const std::vector<double>& errors) {
        return std::ranges::count_if(errors, [&](double error) { return error >= most_mm; });
    };
    const std::regex red(R"(rgb\(69\.8%,9\.4%,16\.9%\))");
    const auto points = std::distance(std::sregex_iterator(svg.begin(), svg.end(), red), {});
    const auto wanted = beyond(errors_mm(truth, false));
    EXPECT_NEAR(static_cast<double>(points), static_cast<double>(wanted), 2.0);
    EXPECT_GT(beyond(errors_mm(truth, true)), wanted + 20);
}

TEST_F(MaterialsDemo, IsDrawnInTheColoursOfItsTruth) {
    const DaemonProcess daemon(directory_, {"--config", config("material")});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    const auto plot = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {SCIPCAT, "plot", target(daemon), "--control", daemon.control().string()});
        return run(more);
    };
    const Outcome materials = plot({"--color", "material", "--echoes"});
    EXPECT_EQ(materials.exit_code, 0) << materials.err;
    EXPECT_THAT(materials.out, AllOf(HasSubstr(" white_paper"), HasSubstr(" reflective_tape"),
                                     HasSubstr(" glass"), HasSubstr("second echo")));
    const Outcome errors = plot({"--color", "error", "--truth", "robot/multi"});
    EXPECT_EQ(errors.exit_code, 0) << errors.err;
    EXPECT_THAT(errors.out, HasSubstr("sent - true, mm: -"));
    const std::string drawn = directory_.path() / "errors.svg";
    ASSERT_EQ(plot({"--color", "error", "-o", drawn}).exit_code, 0);
    expect_colours_of_what_returned(drawn,
                                    control_get(daemon.control(), "/sensors/robot/multi/truth"));
    const Outcome other = plot({"--color", "error", "--truth", "robot/single"});
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.err, HasSubstr("no scan yet"));
    const Outcome clusters = plot({"--color", "material", "--cluster", "2"});
    EXPECT_EQ(clusters.exit_code, 2);
    EXPECT_THAT(clusters.err, HasSubstr("need --cluster 1"));
}

}  // namespace
}  // namespace scipd::tests
