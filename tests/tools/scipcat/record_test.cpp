// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "daemon/models/model_registry.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using protocol::DeviceProfile;
using testing::AnyOf;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::istringstream text(read_file(file));
    for (std::string line; std::getline(text, line);)
        lines.push_back(line);
    return lines;
}

std::vector<double> numbers_of(const std::string& row) {
    std::vector<double> numbers;
    std::istringstream text(row);
    for (std::string cell; std::getline(text, cell, ',');)
        numbers.push_back(std::stod(cell));
    return numbers;
}

struct Csv {
    std::string comments;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
};

Csv read_csv(const std::filesystem::path& file) {
    Csv csv;
    std::string header;
    for (const std::string& line : lines_of(file)) {
        if (line.starts_with('#')) {
            csv.comments += line + "\n";
            header = line.substr(2);
        } else {
            csv.rows.push_back(numbers_of(line));
        }
    }
    std::istringstream names(header);
    for (std::string name; std::getline(names, name, ',');)
        csv.columns.push_back(name);
    return csv;
}

TEST(ScipcatRecord, WritesARowAScan) {
    const DeviceProfile& profile = daemon::find_model("UST-10LX").profile;
    const RoomScanner scanner(profile);
    const TempDir directory;
    const auto file = directory.path() / "room.csv";
    const Outcome outcome = run_scipcat({"record", scanner.tcp_target(), "-o", file, "-n", "4"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "4 scans recorded to " + file.string() + "\n");

    const Csv csv = read_csv(file);
    EXPECT_THAT(csv.comments, HasSubstr("UST-10LX, serial H1614934"));
    EXPECT_THAT(csv.comments, HasSubstr("(S - 540) * 360 / 1440 degrees"));
    ASSERT_EQ(csv.columns.size(), 2U + 1081U);
    EXPECT_EQ(csv.columns[0], "host_time_s");
    EXPECT_EQ(csv.columns[1], "stamp_ms");
    EXPECT_EQ(csv.columns[2 + 540], "distance_mm_540");
    ASSERT_EQ(csv.rows.size(), 4U);
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
        const auto& row = csv.rows[i];
        ASSERT_EQ(row.size(), csv.columns.size());
        EXPECT_GT(row[0], 1.6e9);
        if (i > 0) {
            EXPECT_GE(row[0], csv.rows[i - 1][0]);
            // A revolution takes 25.05 ms.
            EXPECT_THAT(row[1] - csv.rows[i - 1][1], AnyOf(25, 26));
        }
        for (int step = 0; step <= 1080; ++step)
            ASSERT_EQ(row[2 + step], room_reading(profile, step).distance_mm) << step;
    }
}

TEST(ScipcatRecord, WritesAWindowWithIntensities) {
    const DeviceProfile& profile = daemon::find_model("UTM-30LX").profile;
    const RoomScanner scanner(profile);
    const TempDir directory;
    const auto file = directory.path() / "part.csv";
    const Outcome outcome = run_scipcat({"record", scanner.tty(), "-o", file, "-n", "1", "--start",
                                         "500", "--end", "505", "--cluster", "4", "--intensity"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Csv csv = read_csv(file);
    EXPECT_THAT(csv.columns,
                testing::ElementsAre("host_time_s", "stamp_ms", "distance_mm_500",
                                     "distance_mm_504", "intensity_500", "intensity_504"));
    ASSERT_EQ(csv.rows.size(), 1U);
    ASSERT_EQ(csv.rows[0].size(), 6U);
    // The nearest of 500 to 503, a wall ahead: 503 looks most nearly straight at it.
    EXPECT_EQ(csv.rows[0][2], room_reading(profile, 503).distance_mm);
    EXPECT_EQ(csv.rows[0][3], room_reading(profile, 505).distance_mm);
    EXPECT_EQ(csv.rows[0][4], 503);
    EXPECT_EQ(csv.rows[0][5], 505);
}

TEST(ScipcatRecord, WritesAnObjectAScan) {
    const DeviceProfile& profile = daemon::find_model("URG-04LX").profile;
    const RoomScanner scanner(profile);
    const TempDir directory;
    const auto file = directory.path() / "room.jsonl";
    const Outcome outcome = run_scipcat({"record", scanner.tcp_target(), "-o", file, "-n", "3"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto lines = lines_of(file);
    ASSERT_EQ(lines.size(), 3U);
    for (const std::string& line : lines) {
        const auto object = nlohmann::json::parse(line);
        EXPECT_EQ(object["model"], "URG-04LX");
        EXPECT_EQ(object["serial"], profile.serial);
        EXPECT_EQ(object["first_step"], 44);
        EXPECT_NEAR(object["first_angle_rad"], angle_rad(profile, 44), 1e-12);
        EXPECT_NEAR(object["angle_increment_rad"], 2.0 * std::numbers::pi / 1024, 1e-12);
        const std::vector<std::uint32_t> distances = object["distances_mm"];
        ASSERT_EQ(distances.size(), 682U);
        for (int step = 44; step <= 725; ++step)
            ASSERT_EQ(distances[step - 44], room_reading(profile, step).distance_mm) << step;
    }
}

TEST(ScipcatRecord, EndsWellWhenInterrupted) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.jsonl";
    Child child(scipcat({"record", scanner.tty(), "-o", file}));
    while (!std::filesystem::exists(file) || lines_of(file).size() < 3)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    child.signal(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto lines = lines_of(file);
    EXPECT_EQ(outcome.err,
              std::to_string(lines.size()) + " scans recorded to " + file.string() + "\n");
    EXPECT_TRUE(read_file(file).ends_with("}\n"));
    for (const std::string& line : lines)
        EXPECT_TRUE(nlohmann::json::accept(line));

    // The tty has no more scans under way: the scanner was told to stop.
    const auto info = run_scipcat({"info", scanner.tty(), "--json"});
    EXPECT_EQ(nlohmann::json::parse(info.out)["laser"], "OFF");
}

TEST(ScipcatRecord, KeepsWholeScansOfAScannerThatGoesAway) {
    auto scanner = std::make_unique<RoomScanner>(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.jsonl";
    Child child(scipcat({"record", scanner->tcp_target(), "-o", file}));
    while (!std::filesystem::exists(file) || lines_of(file).size() < 3)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    scanner.reset();
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, testing::StartsWith("scipcat: the "));
    for (const std::string& line : lines_of(file))
        EXPECT_TRUE(nlohmann::json::accept(line));
}

}  // namespace
}  // namespace scipd::tests
