// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipbench as a user starts it, in a room whose figures do not matter: that they are there, that
// they hang together, and that what the depth backend tells agrees with the rays.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string room = SCIPD_SCENES "/square_room.sdf";

Outcome scipbench(std::vector<std::string> words) {
    words.insert(words.begin(), SCIPBENCH);
    return run(words);
}

std::string read_file(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(read_file(file));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        std::vector<std::string>& row = rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');)
            row.push_back(cell);
    }
    return rows;
}

bool cannot_draw(const Outcome& outcome) {
    return outcome.err.find("scipd --probe") != std::string::npos;
}

TEST(Scipbench, TellsItsVersion) {
    const Outcome outcome = scipbench({"--version"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "scipbench " SCIPD_VERSION "\n");
}

TEST(Scipbench, FillsThePapersTable3) {
    const TempDir directory;
    const auto csv = directory.path() / "table3.csv";
    const auto plot = directory.path() / "table3.png";
    const Outcome outcome =
        scipbench({"table3", "--scene", room, "-n", "5", "--csv", csv, "-o", plot});
    if (cannot_draw(outcome)) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto rows = read_csv(csv);
    ASSERT_EQ(rows.size(), 14U);
    EXPECT_EQ(rows[0][2], "R_ms");
    EXPECT_EQ(rows[7][0], "1x1000");
    EXPECT_EQ(rows[13][1], "40000");
    for (std::size_t i = 1; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), 2 + 5 * 3U);
        for (std::size_t k = 2; k < rows[i].size(); k += 3) {
            EXPECT_GT(std::stod(rows[i][k]), 0.0);
            EXPECT_LE(std::stod(rows[i][k + 1]), std::stod(rows[i][k]));  // p10, median, p90
            EXPECT_GE(std::stod(rows[i][k + 2]), std::stod(rows[i][k]));
        }
    }
    // Forty thousand rays take longer than one.
    EXPECT_GT(std::stod(rows[13][2]), 10.0 * std::stod(rows[1][2]));
    // What the paper says itself: 50x50 for A, a strip of 300 for B and C.
    EXPECT_THAT(outcome.out, HasSubstr("computer A           from 50x50 on (2500 rays)"));
    EXPECT_THAT(outcome.out, HasSubstr("computer B           from 1x300 on (300 rays)"));
    EXPECT_THAT(outcome.out, HasSubstr("computer C           from 1x300 on (300 rays)"));
    EXPECT_THAT(read_file(plot), StartsWith("\x89PNG\r\n\x1A\n"));
}

TEST(Scipbench, FillsThePapersTable4) {
    const TempDir directory;
    const auto csv = directory.path() / "table4.csv";
    const Outcome outcome = scipbench({"table4", "--scene", room, "-n", "5", "--csv", csv});
    if (cannot_draw(outcome)) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_csv(csv).size(), 14U);
    // The paper's own figures stand beside: 200x200 of computer B.
    EXPECT_THAT(outcome.out, HasSubstr("    1.470    0.540"));
}

TEST(Scipbench, ComparesAllBackends) {
    const TempDir directory;
    const auto plot = directory.path() / "differences.svg";
    const Outcome outcome = scipbench({"compare", "--scene", room, "--model", "URG-04LX", "--poses",
                                       "5", "--height", "0.5", "--json", "-o", plot});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto backends = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(backends.size(), 3U);
    for (const auto& backend : backends) {
        if (backend.contains("missing")) continue;
        EXPECT_GT(backend.at("ms_per_scan"), 0.0);
        EXPECT_LT(backend.at("off_m").at("p99"), 1e-3);
        EXPECT_LT(backend.at("edge_share"), 0.05);
        EXPECT_LT(backend.at("other_surface_share"), 0.01);
    }
    EXPECT_THAT(read_file(plot), HasSubstr("<svg"));
}

/// The numbers behind a backend's name in its last line.
std::vector<double> numbers_of(const std::string& out, const std::string& backend) {
    std::istringstream line(out.substr(out.rfind("\n" + backend + " ") + 1));
    std::string name;
    line >> name;
    std::vector<double> numbers;
    for (double number = 0.0; line >> number;)
        numbers.push_back(number);
    return numbers;
}

// Backends may differ at edges and where a face is met at a flat angle, and nowhere else.
TEST(Scipbench, ComparesEchoesAndReadingsInLight) {
    const Outcome outcome =
        scipbench({"compare", "--scene", room, "--poses", "5", "--height", "0.5", "--light"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* backend : {"embree", "depth", "reference"}) {
        const std::vector<double> numbers = numbers_of(outcome.out, backend);
        if (numbers.empty()) continue;  // this machine cannot draw
        ASSERT_EQ(numbers.size(), 8U) << backend;
        EXPECT_LT(numbers[0], 0.1) << backend;  // echoes, mm, median
        EXPECT_LT(numbers[2], 0.1) << backend;  // power, %, median
        EXPECT_LT(numbers[4], 0.5) << backend;  // readings, mm, median
        EXPECT_LT(numbers[6], 2.0) << backend;  // % of the beams have other echoes
        EXPECT_LT(numbers[7], 2.0) << backend;  // % of the beams have another cause
    }
}

/// As on a machine whose EGL has no driver.
Outcome scipbench_that_cannot_draw(std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"/usr/bin/env", "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere", SCIPBENCH});
    return run(words);
}

MATCHER(TellsWhatIsMissing, "says which package brings a driver, and where more is told") {
    return arg.starts_with("scipbench: ") && arg.find("libgl1-mesa-dri") != arg.npos &&
           arg.find("scipd --probe") != arg.npos;
}

TEST(Scipbench, MeasuresRaysWhereNothingCanBeDrawn) {
    const TempDir directory;
    const auto csv = directory.path() / "table3.csv";
    const auto plot = directory.path() / "table3.svg";
    const Outcome outcome = scipbench_that_cannot_draw(
        {"table3", "--scene", room, "-n", "5", "--csv", csv, "-o", plot});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, TellsWhatIsMissing());
    const auto rows = read_csv(csv);
    ASSERT_EQ(rows.size(), 14U);
    ASSERT_EQ(rows[0].size(), 2 + 5 * 3U);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        // What std::getline() makes of empty cells: the last one is none.
        ASSERT_EQ(rows[i].size(), 2 + 5 * 3 - 1U);
        for (std::size_t k = 2; k < rows[i].size(); ++k)
            EXPECT_EQ(rows[i][k].empty(), k >= 2 + 2 * 3U) << i << " " << k;
        EXPECT_GT(std::stod(rows[i][2]), 0.0);
        EXPECT_GT(std::stod(rows[i][5]), 0.0);
    }
    EXPECT_THAT(outcome.out, testing::ContainsRegex("200x200 .*[0-9] +- +-[^0-9]+\n"));
    EXPECT_THAT(outcome.out, HasSubstr("pixels as they are (ZBwM)        -\n"));
    EXPECT_THAT(outcome.out, HasSubstr("computer B           from 1x300 on (300 rays)"));
    EXPECT_THAT(read_file(plot), StartsWith("<?xml"));
}

TEST(Scipbench, HasNoTable4WhereNothingCanBeDrawn) {
    const Outcome outcome = scipbench_that_cannot_draw({"table4", "--scene", room, "-n", "5"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, TellsWhatIsMissing());
}

TEST(Scipbench, ComparesTheOthersWhereNothingCanBeDrawn) {
    const Outcome outcome =
        scipbench_that_cannot_draw({"compare", "--scene", room, "--poses", "2", "--json"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, TellsWhatIsMissing());
    const auto backends = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(backends.size(), 3U);
    for (const auto& backend : backends)
        EXPECT_EQ(backend.contains("missing"), backend.at("backend") == "depth") << backend;
}

TEST(Scipbench, ReadsWorldsOfAnyKind) {
    // The walls of this storey begin at the floor.
    const Outcome outcome = scipbench(
        {"compare", "--scene", SCIPD_SCENES "/office_map.yaml", "--poses", "2", "--height", "0.5"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("reference"));
}

TEST(Scipbench, TellsWhatIsWrongBeforeItMeasures) {
    const TempDir directory;
    const auto said = [](std::vector<std::string> words) {
        const Outcome outcome = scipbench(std::move(words));
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    };
    EXPECT_THAT(said({"table3", "--scene", room, "--csv", "/no/such/table.csv"}),
                HasSubstr("--csv: there is no directory /no/such"));
    EXPECT_THAT(said({"table4", "--scene", room, "--csv", directory.path()}),
                HasSubstr("is a directory; name a file"));
    EXPECT_THAT(said({"compare", "--scene", room, "-o", "/no/such/picture.png"}),
                HasSubstr("there is no directory /no/such"));
    EXPECT_THAT(said({"compare", "--scene", room, "--model", "UST-11LX"}), HasSubstr("UST-11LX"));
    directory.write("broken.sdf", "<sdf");
    const std::string broken = (directory.path() / "broken.sdf").string();
    EXPECT_THAT(said({"table3", "--scene", broken}), HasSubstr(broken));
}

TEST(Scipbench, SaysWhereNobodyCanStand) {
    const Outcome outcome = scipbench({"compare", "--scene", room, "--height", "500"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("no place to stand 500 m high; try another --height"));
}

TEST(Scipbench, RefusesWrongOptions) {
    EXPECT_EQ(scipbench({"table3"}).exit_code, 2);
    EXPECT_EQ(scipbench({"table3", "--scene", "/no/such.sdf"}).exit_code, 2);
    EXPECT_EQ(scipbench({"table3", "--scene", room, "-o", "picture.pdf"}).exit_code, 2);
    EXPECT_EQ(scipbench({}).exit_code, 2);
}

TEST(Scipbench, TakesNoHeightThatIsNoNumber) {
    for (const std::string height : {"nan", "-nan", "inf", "-inf", "1e7", "high", ""}) {
        const Outcome outcome = scipbench({"compare", "--scene", room, "--height=" + height});
        EXPECT_EQ(outcome.exit_code, 2) << height;
        EXPECT_THAT(outcome.err, HasSubstr("--height")) << height;
    }
    EXPECT_THAT(scipbench({"table3", "--scene", room, "--height", "nan"}).err,
                HasSubstr("--height: must be a number from -1e+06 to 1e+06, not \"nan\""));
}

}  // namespace
}  // namespace scipd::tests
