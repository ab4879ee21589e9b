// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The profile is a configuration that scipd reads, and each of its values says where it is from.
#include <sstream>

#include <gmock/gmock.h>

#include "daemon/config/config_file.h"
#include "daemon/models/model_registry.h"
#include "tests/support/child.h"
#include "tests/tools/scipfit/synthetic_scanner.h"
#include "tools/scipfit/fit_report.h"

namespace scipd::tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using tools::Fit;

Fit fit_of(const char* model, bool with_light) {
    SyntheticScanner scanner(daemon::find_model(model), {}, with_light, 9);
    tools::ScanTable readings = scanner.begin();
    scanner.stand({.x_m = 0.3, .y_m = 0.2}, 80, readings);
    end_recording(readings);
    return tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""), {});
}

std::string profile_of(const Fit& fit) {
    std::ostringstream out;
    write_profile(fit, {}, out);
    return out.str();
}

/// The optics that scipd makes of it.
sim::SensorSpec optics_of(const std::string& profile) {
    const auto config = daemon::parse_config(profile, "profile.yaml");
    return config.robots.at(0).sensors.at(0).model.optics;
}

TEST(Profile, IsReadByScipdAsItWasFitted) {
    const Fit fit = fit_of("UST-10LX", true);
    const sim::SensorSpec optics = optics_of(profile_of(fit));
    ASSERT_TRUE(fit.noise && fit.noise->model.by_intensity);
    EXPECT_NEAR(optics.noise_law.floor_m, fit.noise->s0_mm.value / 1000, 1e-6);
    EXPECT_NEAR(optics.noise_law.weak, fit.noise->i0.value, 0.06);
    EXPECT_NEAR(optics.smoothing.next, fit.smoothing->smoothing.next, 1e-4);
    EXPECT_NEAR(optics.lattice_m, 0.0015, 1e-6);
    EXPECT_EQ(optics.receiver.intensity.size(), fit.light.by_range.size());
    EXPECT_EQ(optics.receiver.intensity_noise.size(), fit.light.noise.size());
}

/// As of a scanner that drove, or that was taken for another: at edges hardly anything but codes.
TEST(Profile, IsReadByScipdWhateverCodesThereAre) {
    Fit fit = fit_of("URG-04LX", false);
    fit.codes.codes = {{0, {.inside = 1000, .beside = 100, .edge = 0}}};
    for (std::uint32_t code = 1; code <= 70; ++code)
        fit.codes.codes[code + 7000] = {.inside = 60, .beside = 60, .edge = 60};
    fit.codes.all = {};
    for (const auto& [code, counts] : fit.codes.codes) {
        fit.codes.all.inside += counts.inside;
        fit.codes.all.beside += counts.beside;
        fit.codes.all.edge += counts.edge;
    }
    const auto config = daemon::parse_config(profile_of(fit), "profile.yaml");
    EXPECT_EQ(config.robots.at(0).sensors.at(0).model.profile.rare_codes.size(), 64U);
}

TEST(Profile, HasNoiseByRangeWhereThatIsTheLaw) {
    const Fit fit = fit_of("URG-04LX", false);
    const sim::SensorSpec optics = optics_of(profile_of(fit));
    ASSERT_TRUE(fit.noise);
    ASSERT_EQ(optics.noise.size(), fit.noise->steps.size());
    EXPECT_NEAR(optics.noise[0].sigma_m, fit.noise->steps[0].value / 1000, 1e-6);
    EXPECT_TRUE(optics.smoothing.median_of_five);
}

TEST(Profile, SaysOfEachValueWhereItIsFrom) {
    std::istringstream lines(profile_of(fit_of("UST-10LX", true)));
    std::string line;
    int values = 0;
    while (std::getline(lines, line) && line != "robots:") {
        if (line.find("  # ") == line.npos && line.find(": {") == line.npos) continue;
        ++values;
        EXPECT_THAT(line, AnyOf(HasSubstr("# measured ("), HasSubstr("# model"),
                                HasSubstr("# assumed"), HasSubstr("# unknown: ")));
    }
    EXPECT_GT(values, 8);
}

TEST(Profile, IsSoundWhereNothingIsKnown) {
    SyntheticScanner scanner(daemon::find_model("UST-10LX"), {}, false, 9);
    tools::ScanTable readings = scanner.begin();
    scanner.stand({}, 10, readings);
    end_recording(readings);
    const Fit fit = tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""), {});
    const auto& model = daemon::find_model("UST-10LX");
    EXPECT_EQ(optics_of(profile_of(fit)).noise_law, model.optics.noise_law);
}

TEST(Scipfit, TellsWhatToNameWhereNothingIs) {
    const Outcome nothing = run({SCIPFIT});
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_THAT(nothing.err, HasSubstr("scipfit: name a recording"));
    const Outcome missing = run({SCIPFIT, "/nowhere.mcap"});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_THAT(missing.err, HasSubstr("/nowhere.mcap"));
}

}  // namespace
}  // namespace scipd::tests
