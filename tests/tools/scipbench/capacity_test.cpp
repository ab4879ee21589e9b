// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipbench capacity as a user starts it, with a few scanners: that the figures are there and hang
// together. How good they are depends on the machine.
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Outcome capacity(std::vector<std::string> words) {
    words.insert(words.begin(), {SCIPBENCH, "capacity"});
    return run(words);
}

using Row = std::map<std::string, double>;

std::vector<Row> rows_of(const std::filesystem::path& csv) {
    std::istringstream lines(read_file(csv));
    const auto cells = [&] {
        std::string line;
        std::getline(lines, line);
        std::vector<std::string> found;
        std::istringstream text(line);
        for (std::string cell; std::getline(text, cell, ',');)
            found.push_back(cell);
        return found;
    };
    const std::vector<std::string> names = cells();
    std::vector<Row> rows;
    for (auto values = cells(); !values.empty(); values = cells()) {
        EXPECT_EQ(values.size(), names.size());
        Row& row = rows.emplace_back();
        for (std::size_t i = 0; i < values.size(); ++i)
            row[names[i]] = std::stod(values[i]);
    }
    return rows;
}

TEST(ScipbenchCapacity, MeasuresSoManyScanners) {
    const TempDir directory;
    const auto csv = directory.path() / "capacity.csv";
    const auto plot = directory.path() / "capacity.svg";
    const Outcome outcome = capacity({"--scanners", "3", "--driving", "--threads", "2", "--seconds",
                                      "2", "--csv", csv, "-o", plot});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    EXPECT_THAT(read_file(plot), HasSubstr("<svg"));
    const std::vector<Row> rows = rows_of(csv);
    ASSERT_EQ(rows.size(), 1U);
    const Row& row = rows.front();
    EXPECT_EQ(row.at("scanners"), 3);
    // Three scanners that turn 40 times a second.
    EXPECT_GT(row.at("scans"), 10);
    EXPECT_LE(row.at("scans"), 3 * (40 * row.at("seconds") + 2));
    for (const char* positive : {"start_s", "bare_cast_us", "poses_us", "stage_cast_us",
                                 "errors_us", "encode_us", "casts_us", "scipd_user_cores"})
        EXPECT_GT(row.at(positive), 0.0) << positive;
    EXPECT_GE(row.at("late_p99_ms"), row.at("late_p50_ms"));
    EXPECT_GE(row.at("late_worst_p99_ms"), row.at("late_p99_ms"));
    EXPECT_GT(row.at("timer_p99_ms"), 0.0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("1081 rays from one pose"), HasSubstr("  errors  "),
                                   HasSubstr("of a bare timer beside")));
}

TEST(ScipbenchCapacity, CountsNoModelThatMovesAmongItsScanners) {
    const TempDir directory;
    const auto csv = directory.path() / "capacity.csv";
    const Outcome outcome =
        capacity({"--scanners", "2", "--moving", "3", "--seconds", "1", "--csv", csv});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("3 models move"));
    const std::vector<Row> rows = rows_of(csv);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows.front().at("scanners"), 2);
    EXPECT_GT(rows.front().at("scans"), 10);
}

TEST(ScipbenchCapacity, SearchesUpToTheMostThatItMayTry) {
    const TempDir directory;
    const auto csv = directory.path() / "capacity.csv";
    const Outcome outcome =
        capacity({"--most", "2", "--model", "URG-04LX-UG01", "--seconds", "1", "--csv", csv});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    const std::vector<Row> rows = rows_of(csv);
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.front().at("scanners"), 2);
    EXPECT_THAT(outcome.out, HasSubstr("URG-04LX-UG01 standing"));
    // On a machine that is too busy even for two, what limits is told instead.
    if (rows.front().at("holds") == 1) {
        ASSERT_EQ(rows.size(), 2U);
        EXPECT_EQ(rows.back().at("scanners"), 1);
        EXPECT_THAT(outcome.out,
                    HasSubstr("2 scanners keep up and lose no scan; no more were tried"));
    }
}

TEST(ScipbenchCapacity, MeasuresTheStart) {
    const Outcome outcome = capacity({"--start", "--scanners", "3", "--seconds", "1"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("3 scanners are ready "),
                                   HasSubstr("in the first two seconds: p50"),
                                   HasSubstr("while they connect and stream: p50")));
}

TEST(ScipbenchCapacity, SaysWhatIsWrongBeforeItMeasures) {
    const auto said = [](std::vector<std::string> words) {
        const Outcome outcome = capacity(std::move(words));
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    };
    EXPECT_THAT(said({"--scanners", "0"}), HasSubstr("--scanners"));
    EXPECT_THAT(said({"--scanners", "2", "--most", "3"}), HasSubstr("--most"));
    EXPECT_THAT(said({"--start", "--most", "3"}), HasSubstr("--most"));
    EXPECT_THAT(said({"--threads", "none"}), HasSubstr("--threads"));
    EXPECT_THAT(said({"--model", "UST-11LX"}), HasSubstr("UST-11LX"));
    EXPECT_THAT(said({"--csv", "/no/such/capacity.csv"}), HasSubstr("no directory /no/such"));
    EXPECT_THAT(said({"-o", "capacity.pdf"}), HasSubstr("must end with .png or .svg"));
    EXPECT_THAT(said({"--scene", "/no/such.sdf"}), HasSubstr("--scene"));
    EXPECT_THAT(said({"--scipd", "/no/such/scipd"}),
                HasSubstr("/no/such/scipd is no program; name scipd with --scipd"));
}

TEST(ScipbenchCapacity, SaysWhyScipdDoesNotStart) {
    for (const char* how : {"--scanners", "--most"}) {
        const Outcome outcome = capacity({how, "1", "--scipd", "/bin/false"});
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.err, HasSubstr("scipd does not start")) << how;
    }
}

}  // namespace
}  // namespace scipd::tests
