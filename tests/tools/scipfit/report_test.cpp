// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a report shows follows from a recording whose noise is known.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/tools/scipfit/synthetic_scanner.h"
#include "tools/scipfit/fit_report.h"
#include "tools/scipfit/report_view.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::Not;
using tools::ReportView;

tools::ScanTable standing_ust(int scans) {
    SyntheticScanner scanner(daemon::find_model("UST-10LX"), {}, true, 3);
    tools::ScanTable readings = scanner.begin();
    scanner.stand({.x_m = 0.3, .y_m = 0.2}, scans, readings);
    end_recording(readings);
    return readings;
}

double sd_of(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values)
        squares += value * value / static_cast<double>(values.size());
    return std::sqrt(squares);
}

// scipd's noise is normal, so the readings lie on the line, and what is simulated spreads as what
// was recorded.
TEST(Report, ShowsTheNoiseThatScipdHas) {
    const tools::ScanTable readings = standing_ust(200);
    const tools::Standing standing = tools::look_at(readings);
    const tools::Fit fit = tools::fit_scanner(standing, tools::kind_of(readings, ""), {});
    const ReportView view = view_of(standing, fit);
    ASSERT_EQ(view.quantiles.size(), 200U);
    for (const tools::Quantile& quantile : view.quantiles)
        EXPECT_NEAR(quantile.seen, quantile.normal, 0.05 + 0.05 * std::abs(quantile.normal));
    EXPECT_NEAR(view.quantiles[4].normal, -2.005, 0.002);  // below which 4.5 of 200 lie
    ASSERT_TRUE(view.piece);
    ASSERT_EQ(view.piece->real_mm.size(), view.piece->simulated_mm.size());
    EXPECT_NEAR(sd_of(view.piece->simulated_mm) / sd_of(view.piece->real_mm), 1.0, 0.06);
    // Means of a hundred readings each: 19 of 20 differ by less than 1.96 sqrt(2 / 100) deviations.
    const double sd_mm =
        std::ranges::max_element(view.beams, {}, &tools::BeamNoise::law_mm)->law_mm;
    EXPECT_GT(view.floor_mean_mm, 0.3);
    EXPECT_LT(view.floor_mean_mm, 1.96 * std::sqrt(0.02) * sd_mm);
}

TEST(Report, IsAPageWithAllPictures) {
    const tools::ScanTable readings = standing_ust(60);
    const tools::Standing standing = tools::look_at(readings);
    const tools::Fit fit = tools::fit_scanner(standing, tools::kind_of(readings, ""), {});
    const std::string page = as_html(standing, fit, room_of(standing));
    for (const char* const title :
         {"The room, from above", "The noise, side by side", "Noise by intensity", "Noise by range",
          "Noise by beam", "Is the noise normal?", "What neighbours and scans share",
          "On readings that it was not fitted to", "Not identifiable"})
        EXPECT_THAT(page, HasSubstr(title));
    EXPECT_THAT(page, Not(HasSubstr("nan")));
    EXPECT_THAT(page, HasSubstr(">y: standard deviation (mm)</text>"));
    EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
}

TEST(Report, SaysWhatIsNotKnownWhereNothingIs) {
    const tools::ScanTable readings = standing_ust(10);
    const tools::Standing standing = tools::look_at(readings);
    const tools::Fit fit = tools::fit_scanner(standing, tools::kind_of(readings, ""), {});
    const std::string page = as_html(standing, fit, std::nullopt);
    EXPECT_THAT(page, Not(HasSubstr("Noise by range")));
    EXPECT_THAT(page, HasSubstr("50 are needed"));
}

}  // namespace
}  // namespace scipd::tests
