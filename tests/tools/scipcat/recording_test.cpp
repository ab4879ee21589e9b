// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings that keep everything, and what scipcat says of recordings.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "daemon/models/model_registry.h"
#include "daemon/recording/wire_decoder.h"
#include "tests/sim/recording/recordings.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using protocol::DeviceProfile;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

const DeviceProfile& profile_of(const char* model) {
    return daemon::find_model(model).profile;
}

std::vector<double> room_ranges(const DeviceProfile& profile) {
    std::vector<double> ranges;
    for (int step = profile.amin; step <= profile.amax; ++step)
        ranges.push_back(room_reading(profile, step).distance_mm);
    return ranges;
}

/// The recording of a room, with all that its options ask for.
std::filesystem::path record(const TempDir& directory, const char* model, const std::string& name,
                             std::vector<std::string> options = {}) {
    const RoomScanner scanner(profile_of(model));
    const auto file = directory.path() / name;
    std::vector<std::string> words = {"record", scanner.tcp_target(), "-o", file, "-n", "4"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_scipcat(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "4 scans recorded to " + file.string() + "\n");
    return file;
}

TEST(ScipcatRecording, KeepsEverythingInMcap) {
    const DeviceProfile& profile = profile_of("UST-10LX");
    const TempDir directory;
    const ReadBack back = read_back(record(directory, "UST-10LX", "room.mcap", {"--intensity"}));
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.warnings, IsEmpty());
    ASSERT_THAT(back.streams, SizeIs(1));
    const sim::ScannerIdentity& identity = back.streams[0].identity;
    EXPECT_EQ(identity.model, "UST-10LX");
    EXPECT_EQ(identity.serial, profile.serial);
    EXPECT_EQ(value_of(identity.version, "SERI"), profile.serial);
    EXPECT_EQ(value_of(identity.parameters, "ARES"), "1440");
    EXPECT_EQ(value_of(identity.state, "STAT"), "sensor is working normally");

    const auto scans = back.scans();
    ASSERT_THAT(scans, SizeIs(4));
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_EQ(scans[i].ranges, room_ranges(profile));
        EXPECT_EQ(scans[i].intensities.at(700), 700);
        EXPECT_EQ(*scans[i].stamp_ms, *scans[0].stamp_ms + 25 * i);
    }
}

/// The bytes alone say the same.
TEST(ScipcatRecording, KeepsTheConversationWithItsTimes) {
    const TempDir directory;
    const ReadBack back = read_back(record(directory, "UST-10LX", "room.mcap"));
    std::string to_scanner;
    daemon::WireDecoder decoder;
    std::vector<sim::RecordedScan> scans;
    sim::HostTime last{};
    for (const auto& bytes : back.bytes()) {
        EXPECT_GE(bytes.host_time, last);
        last = bytes.host_time;
        if (bytes.way == sim::Way::to_scanner) to_scanner += bytes.bytes;
        for (auto& scan : decoder.take(bytes))
            scans.push_back(std::move(scan));
    }
    for (const char* const request : {"VV\n", "PP\n", "II\n", "MD00001080010", "QT\n"})
        EXPECT_THAT(to_scanner, HasSubstr(request));
    ASSERT_GE(scans.size(), 4U);
    scans.resize(4);
    EXPECT_EQ(scans, back.scans());
    EXPECT_EQ(decoder.identity().version, back.streams[0].identity.version);
    EXPECT_EQ(decoder.damaged_scans(), 0U);
}

TEST(ScipcatRecording, IsReadByUrgBenri) {
    const DeviceProfile& profile = profile_of("URG-04LX");
    const TempDir directory;
    const auto file = record(directory, "URG-04LX", "room.ubh");
    const std::string text = read_file(file);
    EXPECT_THAT(text, StartsWith("[appName]\nscipd\n[appVersion]\nscipcat " SCIPD_VERSION "\n"
                                 "[model]\nURG-04LX\n"));
    EXPECT_THAT(text, HasSubstr("[captureMode]\nMD_Capture_mode\n[startStep]\n44\n[endStep]\n725\n"
                                "[grouping]\n1\n[frontStep]\n384\n[totalSteps]\n1024\n"
                                "[minDistance]\n20\n[maxDistance]\n5600\n[motorSpeed]\n600\n"
                                "[scanMsec]\n100\n[timestamp]\n"));
    const ReadBack back = read_back(file);
    ASSERT_THAT(back.scans(), SizeIs(4));
    EXPECT_EQ(back.scans()[3].ranges, room_ranges(profile));
}

/// Waits for so many scans in the file of a recording that goes on.
void wait_for_scans(const std::filesystem::path& file, std::size_t count) {
    while (!std::filesystem::exists(file) || read_back(file).scans().size() < count)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

TEST(ScipcatRecording, OpensWhenItsProgramWasKilled) {
    const RoomScanner scanner(profile_of("UST-10LX"));
    const TempDir directory;
    for (const std::string name : {"room.mcap", "room.ubh", "room.csv", "room.jsonl"}) {
        const auto file = directory.path() / name;
        Child child(scipcat({"record", scanner.tcp_target(), "-o", file}));
        wait_for_scans(file, 10);
        child.signal(SIGKILL);
        EXPECT_EQ(child.wait().exit_code, -1);
        const ReadBack back = read_back(file);
        EXPECT_EQ(back.fault, "") << name;
        ASSERT_GE(back.scans().size(), 10U) << name;
        EXPECT_EQ(back.scans().back().ranges, room_ranges(scanner.profile())) << name;
    }
}

TEST(ScipcatRecording, EndsWellWhenInterrupted) {
    const RoomScanner scanner(profile_of("UST-10LX"));
    const TempDir directory;
    const auto file = directory.path() / "room.mcap";
    Child child(scipcat({"record", scanner.tcp_target(), "-o", file}));
    wait_for_scans(file, 10);
    child.signal(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const ReadBack back = read_back(file);
    EXPECT_THAT(back.warnings, IsEmpty());
    EXPECT_EQ(outcome.err,
              std::to_string(back.scans().size()) + " scans recorded to " + file.string() + "\n");
}

/// Also of a scanner that goes away, the index is written.
TEST(ScipcatRecording, IsWholeWhenTheScannerGoesAway) {
    auto scanner = std::make_unique<RoomScanner>(profile_of("UST-10LX"));
    const TempDir directory;
    const auto file = directory.path() / "room.mcap";
    Child child(scipcat({"record", scanner->tcp_target(), "-o", file}));
    wait_for_scans(file, 10);
    scanner.reset();
    EXPECT_EQ(child.wait().exit_code, 1);
    EXPECT_THAT(read_back(file).warnings, IsEmpty());
}

TEST(ScipcatRecordingInfo, IsReadable) {
    const TempDir directory;
    const auto file = record(directory, "UST-10LX", "room.mcap", {"--intensity"});
    const Outcome outcome = run_scipcat({"info", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith(file.string() + ": mcap\nscanner (foxglove.LaserScan)\n"));
    EXPECT_THAT(outcome.out, HasSubstr("  model       UST-10LX\n"));
    EXPECT_THAT(outcome.out, HasSubstr("  scans       4 of 1081 steps, 0.075 s, 40.00 a second"));
    EXPECT_THAT(outcome.out, HasSubstr("  values      mm with the scanner's codes, intensities\n"
                                       "  codes       no distance: 6.4 %\n"
                                       "  times       header stamps\n"));
}

TEST(ScipcatRecordingInfo, IsJsonForPrograms) {
    const TempDir directory;
    for (const std::string format : {"mcap", "ubh", "csv", "jsonl"}) {
        const auto file = record(directory, "UTM-30LX", "room." + format, {"--end", "99"});
        const Outcome outcome = run_scipcat({"info", file, "--json"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto document = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(document["format"], format);
        EXPECT_EQ(document["device"]["model"], "UTM-30LX");
        EXPECT_EQ(document["device"]["dmax_mm"], 60000);
        EXPECT_EQ(document["scans"], 4);
        EXPECT_EQ(document["steps"], 100);
        EXPECT_NEAR(document["seconds"], 0.075, 0.001);
        EXPECT_EQ(document["intensities"], false);
        EXPECT_EQ(document["codes"], true);
        EXPECT_THAT(document["gaps"], IsEmpty());
        EXPECT_THAT(document["streams"], SizeIs(1));
        EXPECT_THAT(document["warnings"], IsEmpty());
    }
}

TEST(ScipcatRecordingInfo, TellsOfGaps) {
    std::string lines;
    for (const int stamp : {1000, 1025, 1050, 1150, 1175})
        lines += "{\"stamp_ms\":" + std::to_string(stamp) + ",\"distances_mm\":[1]}\n";
    const TempDir directory;
    const auto file = directory.write("gap.jsonl", lines);
    const auto document = nlohmann::json::parse(run_scipcat({"info", file, "--json"}).out);
    ASSERT_THAT(document["gaps"], SizeIs(1));
    EXPECT_EQ(document["gaps"][0]["after_scan"], 3);
    EXPECT_EQ(document["gaps"][0]["seconds"], 0.1);
    EXPECT_THAT(run_scipcat({"info", file}).out, HasSubstr("  gaps        0.100 s after scan 3\n"));
}

// As where a scanner was switched off and on, or a replay begins its round again.
TEST(ScipcatRecordingInfo, TakesNoClockThatBeganAgainForOneThatWrapped) {
    std::string lines;
    for (const int stamp : {16777200, 16777208, 0, 8, 9000, 9008, 100, 108})
        lines += "{\"stamp_ms\":" + std::to_string(stamp) + ",\"distances_mm\":[1]}\n";
    const TempDir directory;
    const auto file = directory.write("again.jsonl", lines);
    const Outcome outcome = run_scipcat({"info", file, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto document = nlohmann::json::parse(outcome.out);
    EXPECT_NEAR(document.at("seconds").get<double>(), 0.008 * 5 + 8.992, 1e-9);
    ASSERT_EQ(document.at("gaps").size(), 1U);
    EXPECT_EQ(document.at("gaps").at(0).at("after_scan"), 4);
}

TEST(ScipcatRecordingInfo, SaysWhatATableWasTakenFor) {
    const TempDir directory;
    const auto file = directory.write("table.csv", "-90,0,90,180\n1.5,2.5,0.5,3.5\n");
    EXPECT_THAT(run_scipcat({"info", file}).out,
                HasSubstr("scanner (rows of numbers under angles in degrees, taken for metres)\n"
                          "  scans       1 of 4 steps\n"));
}

TEST(ScipcatRecordingInfo, RefusesWhatIsNone) {
    const TempDir directory;
    const auto file = directory.write("letter.txt", "Dear reader,\n");
    const Outcome outcome = run_scipcat({"info", file});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err,
                StartsWith("scipcat: " + file.string() + ": begins like no recording"));
    EXPECT_THAT(run_scipcat({"info", directory.path()}).err,
                HasSubstr("is a folder without a bag (.mcap, .db3, .bag); name a recording"));
}

TEST(ScipcatRecordingPlot, DrawsAScan) {
    const TempDir directory;
    const DeviceProfile& profile = profile_of("UST-10LX");
    const auto file = record(directory, "UST-10LX", "room.mcap");
    const Outcome outcome = run_scipcat({"plot", file, "--scan", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr(std::to_string(room_points(profile)) + " points in 1081 directions"));
    EXPECT_THAT(run_scipcat({"plot", file, "--scan", "5"}).err, HasSubstr("has 4 scans"));
    EXPECT_THAT(run_scipcat({"plot", file, "--stream", "rear"}).err,
                HasSubstr("has no stream \"rear\" with scans; it has scanner"));
    EXPECT_THAT(run_scipcat({"plot", file, "--color", "error"}).err,
                HasSubstr("need a scanner of a scipd"));
}

/// The marks of an SVG, without its words.
std::vector<std::string> points_in(const std::filesystem::path& picture) {
    std::ifstream in(picture);
    std::vector<std::string> points;
    for (std::string line; std::getline(in, line);) {
        if (line.find("<path") != line.npos) points.push_back(line);
    }
    EXPECT_THAT(points, SizeIs(testing::Gt(600)));
    return points;
}

// A table looks as the recording that it was cut from.
TEST(ScipcatRecordingPlot, DrawsATableAsOfAModel) {
    const TempDir directory;
    const auto whole = record(directory, "URG-04LX", "room.jsonl");
    std::string row;
    for (const double range_mm : room_ranges(profile_of("URG-04LX")))
        row += std::to_string(static_cast<int>(range_mm)) + ' ';
    const auto table = directory.write("table.txt", row + "\n");
    const auto picture_of = [&](const std::vector<std::string>& words) {
        const auto file = directory.path() / "plot.svg";
        std::vector<std::string> all = {"plot", "-o", file, "--title", "one"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run_scipcat(all);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return points_in(file);
    };
    EXPECT_EQ(picture_of({table, "--model", "URG-04LX"}), picture_of({whole}));
    EXPECT_THAT(run_scipcat({"plot", table}).err, HasSubstr("name the model that it was recorded"));
    EXPECT_THAT(run_scipcat({"plot", table, "--model", "UST-10LX"}).err,
                HasSubstr("where its 682 values look, and UST-10LX has 1081 steps"));
    EXPECT_THAT(run_scipcat({"plot", table, "--model", "UST"}).err, HasSubstr("UST-10LX"));
}

}  // namespace
}  // namespace scipd::tests
