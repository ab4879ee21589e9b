// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipcat compare` as a user calls it: scanners, recordings, reports, exit codes.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "daemon/models/model_registry.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const protocol::DeviceProfile& ust() {
    return daemon::find_model("UST-10LX").profile;
}

/// The room with its steps 500 to 520 so much nearer.
LoopbackScanner changed_room(std::uint32_t nearer_mm) {
    return LoopbackScanner(ust(), [=](int step) {
        Reading reading = room_reading(ust(), step);
        if (step >= 500 && step <= 520) reading.distance_mm -= nearer_mm;
        return reading;
    });
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path record_room(const TempDir& directory, const char* name) {
    const RoomScanner scanner(ust());
    const auto file = directory.path() / name;
    const Outcome outcome = run_scipcat({"record", scanner.tcp_target(), "-o", file, "-n", "12"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file;
}

TEST(ScipcatCompare, FindsTheSameScannerAlike) {
    const RoomScanner a(ust());
    const RoomScanner b(ust());
    const Outcome outcome =
        run_scipcat({"compare", a.tcp_target(), b.tcp_target(), "-n", "10", "--intensity"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("They are alike, as far as 10 scans can tell."));
}

TEST(ScipcatCompare, NamesWhatDiffersFromARecording) {
    const TempDir directory;
    const auto before = record_room(directory, "room.jsonl");
    const LoopbackScanner after = changed_room(310);
    const Outcome outcome =
        run_scipcat({"compare", before, after.tcp_target(), "-n", "12", "--json"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "scipcat: B differs from A\n");
    const json document = json::parse(outcome.out);
    EXPECT_EQ(document.at("verdict"), "differ");
    EXPECT_EQ(document.at("a").at("scans"), 12);
    EXPECT_EQ(document.at("b").at("model"), "UST-10LX");
    ASSERT_EQ(document.at("differ").size(), 1U) << document.at("differ");
    const json& difference = document.at("differ").at(0);
    EXPECT_EQ(difference.at("what"), "mean");
    EXPECT_EQ(difference.at("from"), 500);
    EXPECT_EQ(difference.at("to"), 520);
    EXPECT_NEAR(difference.at("b").get<double>() - difference.at("a").get<double>(), -310, 0.5);
    for (const char* const member : {"mean_mm", "sd_a_mm", "sd_b_mm", "neighbours_a",
                                     "neighbours_b", "codes_a", "codes_b", "floor"})
        EXPECT_TRUE(document.contains(member)) << member;
    EXPECT_TRUE(document.at("floor").contains("mean_mm"));
    EXPECT_TRUE(document.at("floor").contains("sd_mm"));
    EXPECT_GT(document.at("codes_a").at("no distance").get<double>(), 0.04);
}

/// The numbers beside each vertical axis of a page.
std::vector<std::vector<double>> axes_of(const std::string& page) {
    const std::regex tick(R"(<svg|class="right">([^<]+)<)");
    std::vector<std::vector<double>> axes;
    for (std::sregex_iterator it(page.begin(), page.end(), tick), end; it != end; ++it) {
        if ((*it)[1].matched)
            axes.back().push_back(std::stod((*it)[1]));
        else
            axes.emplace_back();
    }
    std::erase_if(axes, [](const auto& axis) { return axis.empty(); });
    return axes;
}

TEST(ScipcatCompare, WritesReports) {
    const TempDir directory;
    const auto before = record_room(directory, "room.mcap");
    const LoopbackScanner after = changed_room(310);
    for (const char* const name : {"report.html", "report.png", "report.json"}) {
        const auto report = directory.path() / name;
        const Outcome outcome =
            run_scipcat({"compare", before, after.tcp_target(), "-n", "12", "-o", report});
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("steps 500–520 nearer by 0.31 m"));
    }
    const std::string page = text_of(directory.path() / "report.html");
    EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(page, HasSubstr("steps 500–520 nearer by 0.31 m"));
    EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
    EXPECT_THAT(page, Not(HasSubstr("http")));  // it needs nothing else
    const auto axes = axes_of(page);
    EXPECT_GE(axes.size(), 2U);
    for (const std::vector<double>& axis : axes) {
        ASSERT_GE(axis.size(), 2U);
        const double step = std::abs(axis[1] - axis[0]);
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
        EXPECT_THAT(mantissa, AnyOf(DoubleNear(1, 1e-6), DoubleNear(2, 1e-6), DoubleNear(5, 1e-6)));
        for (const double value : axis)
            EXPECT_NEAR(value / step, std::round(value / step), 1e-6) << value;
    }
    EXPECT_THAT(text_of(directory.path() / "report.png"), StartsWith("\x89PNG"));
    EXPECT_EQ(json::parse(text_of(directory.path() / "report.json")).at("verdict"), "differ");
}

/// Twenty scans, each a line of JSON; `reading` is of a scan and a step.
std::filesystem::path write_scans(const TempDir& directory, const char* name,
                                  const std::function<int(int, int)>& reading, int light = 500) {
    const auto file = directory.path() / name;
    std::ofstream out(file);
    for (int scan = 0; scan < 20; ++scan) {
        json object{{"first_angle_rad", -1}, {"angle_increment_rad", 0.01}};
        object["stamp_ms"] = 25 * scan;
        for (int step = 0; step < 200; ++step) {
            object["distances_mm"].push_back(reading(scan, step));
            object["intensities"].push_back(light);
        }
        out << object << '\n';
    }
    return file;
}

/// A few millimetres that no two scans share.
int noise_mm(int scan, int step) {
    return (scan * 7919 + step * 104729) % 11 - 5;
}

void expect_numbers(const std::vector<std::string>& arguments) {
    const TempDir directory;
    const auto page = directory.path() / "report.html";
    std::vector<std::string> with_page{"compare", "-o", page};
    with_page.insert(with_page.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_scipcat(with_page);
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    for (const std::string& text : {outcome.out, text_of(page)})
        EXPECT_THAT(text, Not(ContainsRegex("(^|[ >+-])(nan|inf)([ <%]|$)")));
}

// A robot that comes and goes: neither half of its scans says how well a step repeats.
TEST(ScipcatCompare, SaysWhyADriveHasNoFloor) {
    const TempDir directory;
    const auto drive = write_scans(directory, "drive.jsonl", [](int scan, int step) {
        return 1000 + 500 * (scan % 3 == 2) + noise_mm(scan, step);
    });
    const Outcome outcome = run_scipcat({"compare", drive, drive});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("The detection limit is not known: no step of A sees a single "
                          "static surface."));
    EXPECT_THAT(outcome.out, ContainsRegex("  range .* not known\n"));
    expect_numbers({drive, drive});
    const json floor = json::parse(run_scipcat({"compare", drive, drive, "--json"}).out)["floor"];
    EXPECT_TRUE(floor.at("mean_mm").is_null());
    EXPECT_THAT(floor.at("why").get<std::string>(), StartsWith("The detection limit is not known"));
}

TEST(ScipcatCompare, TakesNoMultipleOfNothing) {
    const TempDir directory;
    const auto steady = [](int, int) { return 1000; };
    const auto ideal = write_scans(directory, "ideal.jsonl", steady, 0);
    const auto real = write_scans(directory, "real.jsonl",
                                  [](int scan, int step) { return 1000 + noise_mm(scan, step); });
    expect_numbers({ideal, real});
    const Outcome outcome = run_scipcat({"compare", ideal, real});
    EXPECT_THAT(outcome.out, HasSubstr("steps 0–199 brighter: 500 instead of 0\n"));
    EXPECT_THAT(outcome.out, ContainsRegex("  range .* 0.00 mm\n"));  // its halves are the same
}

TEST(ScipcatCompare, RefusesWhatCannotBeCompared) {
    const TempDir directory;
    const auto room = record_room(directory, "room.csv");
    const auto brief = directory.path() / "brief.jsonl";
    std::ofstream(brief) << R"({"distances_mm": [1000, 2000]})" << '\n';
    const Outcome few = run_scipcat({"compare", room, brief});
    EXPECT_EQ(few.exit_code, 2);
    EXPECT_EQ(few.err, "scipcat: " + brief.string() +
                           " has 1 scan; at least 4 are needed, and 100 are better\n");
    const Outcome nobody = run_scipcat({"compare", room, "tcp://127.0.0.1:1"});
    EXPECT_EQ(nobody.exit_code, 2);
    EXPECT_THAT(nobody.err, StartsWith("scipcat: tcp://127.0.0.1:1: "));
    const Outcome wrong = run_scipcat({"compare", room, room, "-o", "report.gif"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("ends in none of .html, .png and .json"));
    const Outcome part = run_scipcat({"compare", room, room, "--start", "400"});
    EXPECT_EQ(part.exit_code, 2);
    EXPECT_THAT(part.err, HasSubstr("are requests to a scanner: leave them out for a recording"));
    const Outcome stream = run_scipcat({"compare", room, room, "--stream-b", "rear"});
    EXPECT_EQ(stream.exit_code, 2);
    EXPECT_THAT(stream.err, HasSubstr("has no stream \"rear\" with scans; it has "));
}

}  // namespace
}  // namespace scipd::tests
