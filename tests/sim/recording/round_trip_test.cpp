// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is written can be read, value for value, in each format that we write.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "sim/recording/create_recording.h"
#include "tests/sim/recording/recordings.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {
namespace {

using sim::RecordedScan;
using sim::ScannerIdentity;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr auto all_values = {Values::ranges, Values::intensities, Values::echoes,
                             Values::echoes_with_intensities};

std::filesystem::path write(const TempDir& directory, const std::string& ending,
                            const std::vector<RecordedScan>& scans,
                            const ScannerIdentity& identity = some_scanner()) {
    const auto path = directory.path() / ("recording" + ending);
    const auto writer = sim::create_recording(path, identity, {"scipcat", "1.0"});
    for (const RecordedScan& scan : scans)
        writer->write(scan);
    writer->finish();
    return path;
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, KeepsEachValue) {
    const TempDir directory;
    for (const Values values : all_values) {
        std::vector<RecordedScan> scans;
        for (unsigned n = 0; n < 5; ++n)
            scans.push_back(some_scan(n, values, n == 0 ? 1 : scans[0].directions.cluster));
        const ReadBack back = read_back(write(directory, GetParam(), scans));
        EXPECT_EQ(back.fault, "");
        EXPECT_THAT(back.warnings, IsEmpty());
        EXPECT_EQ("." + back.format, GetParam());
        ASSERT_THAT(back.streams, SizeIs(1));
        EXPECT_EQ(back.scans(), scans) << static_cast<int>(values);
    }
}

TEST_P(RoundTrip, KeepsClusters) {
    const TempDir directory;
    const std::vector scans = {some_scan(1, Values::intensities, 3)};
    EXPECT_EQ(read_back(write(directory, GetParam(), scans)).scans(), scans);
}

TEST_P(RoundTrip, SaysWhoseScansTheyAre) {
    const TempDir directory;
    const ScannerIdentity wanted = some_scanner();
    const ReadBack back = read_back(write(directory, GetParam(), {some_scan(0)}));
    ASSERT_THAT(back.streams, SizeIs(1));
    const ScannerIdentity& identity = back.streams[0].identity;
    EXPECT_EQ(identity.model, wanted.model);
    EXPECT_EQ(identity.serial, wanted.serial);
    EXPECT_EQ(identity.min_range_m, wanted.min_range_m);
    EXPECT_EQ(identity.max_range_m, wanted.max_range_m);
    EXPECT_EQ(identity.steps_per_turn, wanted.steps_per_turn);
    EXPECT_EQ(identity.front_step, wanted.front_step);
}

TEST_P(RoundTrip, ReplacesAnOldFile) {
    const TempDir directory;
    write(directory, GetParam(), {some_scan(0), some_scan(1)});
    EXPECT_THAT(read_back(write(directory, GetParam(), {some_scan(2)})).scans(),
                ElementsAre(some_scan(2)));
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(".mcap", ".ubh", ".csv", ".jsonl"),
                         [](const auto& format) { return format.param.substr(1); });

TEST(Recordings, OfMcapKeepAllThatTheScannerHasSaid) {
    const TempDir directory;
    const ReadBack back = read_back(write(directory, ".mcap", {some_scan(0)}));
    ASSERT_THAT(back.streams, SizeIs(1));
    EXPECT_EQ(back.streams[0].identity, some_scanner());
    EXPECT_TRUE(back.streams[0].has_scans);
    EXPECT_TRUE(back.streams[0].has_bytes);
}

TEST(Recordings, OfMcapKeepTheConversation) {
    const TempDir directory;
    const auto path = directory.path() / "talk.mcap";
    const sim::HostTime time(std::chrono::nanoseconds(1'769'860'800'123'456'789));
    const std::vector<sim::RecordedBytes> talk = {
        {sim::Way::to_scanner, time, "VV\n"},
        {sim::Way::from_scanner, time + std::chrono::nanoseconds(1), std::string("VV\n\0P\n", 6)}};
    const auto writer = sim::create_recording(path, some_scanner(), {"scipcat", "1.0"});
    for (const auto& bytes : talk)
        writer->write(bytes);
    writer->finish();
    EXPECT_EQ(read_back(path).bytes(), talk);
}

TEST(Recordings, KeepStampsInMicroseconds) {
    const TempDir directory;
    RecordedScan scan = some_scan(0);
    scan.stamp_ms.reset();
    scan.stamp_us = 1'234'567'890'123;
    for (const std::string ending : {".mcap", ".jsonl"})
        EXPECT_THAT(read_back(write(directory, ending, {scan})).scans(), ElementsAre(scan));
}

TEST(Recordings, OfOtherEndingsAreNotMade) {
    const TempDir directory;
    EXPECT_THROW((void)sim::create_recording(directory.path() / "a.bag", {}, {}),
                 std::invalid_argument);
    EXPECT_THROW((void)sim::create_recording(directory.path() / "no" / "a.csv", {}, {}),
                 std::runtime_error);
}

TEST(Recordings, OfCsvHaveNoRoomForOtherSteps) {
    const TempDir directory;
    EXPECT_THROW(write(directory, ".csv", {some_scan(0), some_scan(1, Values::echoes)}),
                 std::invalid_argument);
}

/// A file of those scans, cut off at each byte: what was whole is read, and nothing else.
TEST_P(RoundTrip, ReadsWhatIsWholeOfAFileThatWasCutOff) {
    const TempDir directory;
    std::vector<RecordedScan> scans;
    for (unsigned n = 0; n < 3; ++n)
        scans.push_back(some_scan(n, Values::echoes_with_intensities));
    const std::string whole = bytes_of(write(directory, GetParam(), scans));
    std::size_t most = 0;
    for (std::size_t size = 1; size <= whole.size(); ++size) {
        const ReadBack back = read_bytes(whole.substr(0, size));
        const std::vector<RecordedScan> read = back.scans();
        ASSERT_LE(read.size(), scans.size());
        ASSERT_EQ(read, std::vector(scans.begin(), scans.begin() + read.size())) << size;
        ASSERT_GE(read.size(), most) << size;
        most = read.size();
    }
    EXPECT_EQ(most, scans.size());
}

}  // namespace
}  // namespace scipd::tests
