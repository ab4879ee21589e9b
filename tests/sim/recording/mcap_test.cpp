// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "sim/recording/create_recording.h"
#include "sim/recording/mcap/mcap_writer.h"
#include "sim/recording/mcap/record_reader.h"
#include "sim/recording/open_recording.h"
#include "tests/sim/recording/recordings.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {
namespace {

using sim::mcap::Compression;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

/// Ten scans, a second of them in a chunk.
std::filesystem::path ten_scans(const TempDir& directory, Compression compression, bool finish) {
    const auto path = directory.path() / "ten.mcap";
    const auto writer = sim::create_recording(path, some_scanner(), {"test", "1", compression});
    for (unsigned n = 0; n < 10; ++n)
        writer->write(some_scan(20 * n));  // half a second apart
    if (finish) writer->finish();
    return path;
}

TEST(Mcap, IsPackedInEachWay) {
    const TempDir directory;
    for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
        const ReadBack back = read_back(ten_scans(directory, compression, true));
        EXPECT_EQ(back.fault, "");
        EXPECT_THAT(back.warnings, IsEmpty());
        ASSERT_THAT(back.scans(), SizeIs(10));
        EXPECT_EQ(back.scans()[9], some_scan(180));
    }
}

TEST(Mcap, OpensWhenItsWriterWasKilled) {
    const TempDir directory;
    const ReadBack back = read_back(ten_scans(directory, Compression::zstd, false));
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(9));  // the tenth was in no chunk yet
    EXPECT_THAT(back.warnings, ElementsAre(HasSubstr("has no index: its writer was stopped")));
}

TEST(Mcap, SaysWhichChunkIsDamaged) {
    const TempDir directory;
    std::string bytes = bytes_of(ten_scans(directory, Compression::none, true));
    const std::size_t value = bytes.find("65533");
    ASSERT_NE(value, bytes.npos);
    bytes[value] = '7';
    const ReadBack back = read_bytes(bytes);
    EXPECT_THAT(back.fault, AllOf(StartsWith("FILE: byte "),
                                  HasSubstr("the chunk is damaged: its sum is wrong")));
    EXPECT_THAT(back.scans(), IsEmpty());
}

TEST(Mcap, PassesOverWhatIsEarlyUnread) {
    const TempDir directory;
    std::string bytes = bytes_of(ten_scans(directory, Compression::none, false));
    std::size_t fifth = 0;
    for (int n = 0; n < 5; ++n)
        fifth = bytes.find("\"timestamp\":", fifth + 1);
    ASSERT_NE(fifth, bytes.npos);
    bytes[fifth + 1] = 'T';  // whoever reads its chunk complains
    auto recording = sim::open_recording(sim::InputFile::of_bytes("FILE", bytes)).value();
    std::vector<sim::RecordedScan> scans;
    recording->skip_ahead(std::chrono::seconds(4));
    for (auto item = recording->next(); item && *item; item = recording->next()) {
        if (const auto* const scan = std::get_if<sim::RecordedScan>(&(*item)->what))
            scans.push_back(*scan);
    }
    ASSERT_FALSE(scans.empty());
    EXPECT_EQ(scans.front(), some_scan(0));
    EXPECT_EQ(scans.back(), some_scan(160));
    EXPECT_THAT(scans, testing::Not(testing::Contains(some_scan(80))));
    EXPECT_NE(read_bytes(bytes).fault, "");
}

TEST(Mcap, RefusesOtherFiles) {
    EXPECT_THAT(read_bytes("\x89MCAP9\r\n").fault, HasSubstr("is no MCAP file of version 0"));
}

TEST(Mcap, ToleratesZerosBehindItsRecords) {
    const TempDir directory;
    const std::string bytes = bytes_of(ten_scans(directory, Compression::lz4, false));
    const ReadBack back = read_bytes(bytes + std::string(4096, '\0'));
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(9));
    EXPECT_THAT(back.warnings, ElementsAre(HasSubstr("ends within the record at byte " +
                                                     std::to_string(bytes.size()))));
}

TEST(Mcap, NamesWhatIsLeftOut) {
    const TempDir directory;
    const auto path = directory.path() / "other.mcap";
    sim::mcap::Writer writer(path);
    const auto schema = writer.add_schema("tf2_msgs/msg/TFMessage", "ros2msg", "");
    const auto channel = writer.add_channel("/tf", schema, "cdr");
    writer.write(channel, 1, "x");
    writer.finish();
    const ReadBack back = read_back(path);
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.streams, IsEmpty());
    EXPECT_THAT(back.warnings,
                ElementsAre(HasSubstr("no scans are read from it: /tf (tf2_msgs/msg/TFMessage)")));
}

TEST(Mcap, KeepsScannersOfSeveralPrefixesApart) {
    const TempDir directory;
    const auto path = directory.path() / "two.mcap";
    sim::mcap::Writer writer(path);
    writer.add_metadata({"scip", {{"prefix", "/rear"}, {"model", "URG-04LX"}}});
    const auto front = writer.add_channel("/front/wire/from_scanner", 0, "scip");
    const auto rear = writer.add_channel("/rear/wire/to_scanner", 0, "scip");
    writer.write(front, 1, "a");
    writer.write(rear, 2, "b");
    writer.finish();
    const ReadBack back = read_back(path);
    ASSERT_THAT(back.streams, SizeIs(2));
    EXPECT_EQ(back.streams[0].name, "/front");
    EXPECT_EQ(back.streams[1].name, "/rear");
    EXPECT_EQ(back.streams[1].identity.model, "URG-04LX");
    EXPECT_FALSE(back.streams[0].has_scans);
    EXPECT_THAT(back.bytes(), SizeIs(2));
}

TEST(Mcap, HasTheSumsOfItsSpecification) {
    EXPECT_EQ(sim::mcap::crc32("123456789"), 0xCBF43926U);
    EXPECT_EQ(sim::mcap::crc32(""), 0U);
}

}  // namespace
}  // namespace scipd::tests
