// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "sim/recording/create_recording.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/mcap/mcap_format.h"
#include "sim/recording/mcap/mcap_writer.h"
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
    EXPECT_THAT(back.warnings, ElementsAre(HasSubstr("has no index: its recorder was stopped")));
}

/// Where the chunks of a file begin, and their sizes.
std::vector<std::pair<std::size_t, std::size_t>> chunks_of(const std::string& file) {
    std::vector<std::pair<std::size_t, std::size_t>> chunks;
    for (std::size_t at = sim::mcap::magic.size(); at + sim::mcap::record_head < file.size();) {
        const auto length =
            sim::ByteReader(std::string_view(file).substr(at + 1, 8)).number<std::uint64_t>();
        if (file[at] == static_cast<char>(sim::mcap::Opcode::chunk))
            chunks.emplace_back(at, sim::mcap::record_head + length);
        at += sim::mcap::record_head + length;
    }
    return chunks;
}

TEST(Mcap, LeavesOutDamagedChunksAndSaysWhich) {
    const TempDir directory;
    const std::string whole = bytes_of(ten_scans(directory, Compression::none, true));
    const auto chunks = chunks_of(whole);
    ASSERT_THAT(chunks, SizeIs(4));  // of three scans, the last of one
    std::string bytes = whole;
    bytes[bytes.find("65533", chunks[2].first)] = '7';
    const ReadBack back = read_bytes(bytes);
    EXPECT_EQ(back.fault, "");
    ASSERT_THAT(back.scans(), SizeIs(7));
    EXPECT_EQ(back.scans()[6], some_scan(20 * 9));
    EXPECT_THAT(back.warnings,
                ElementsAre("FILE: byte " + std::to_string(chunks[2].first) + ": the chunk of " +
                            std::to_string(chunks[2].second) +
                            " bytes is damaged: its checksum is wrong; it is left out"));
    for (const auto& [byte, size] : chunks)
        bytes[byte + size - 1] = '7';
    EXPECT_THAT(read_bytes(bytes).fault, AllOf(StartsWith("FILE: byte "), HasSubstr("is damaged")));
}

// The index at the end of the file says where reading can go on.
TEST(Mcap, GoesOnBehindARecordWithAWrongLength) {
    const TempDir directory;
    std::string bytes = bytes_of(ten_scans(directory, Compression::zstd, true));
    const auto chunks = chunks_of(bytes);
    bytes[chunks[1].first + 6] = '\x7F';
    const ReadBack back = read_bytes(bytes);
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.scans(), SizeIs(7));
    EXPECT_THAT(back.warnings, ElementsAre("FILE: byte " + std::to_string(chunks[1].first) +
                                           ": the record here is damaged, up to byte " +
                                           std::to_string(chunks[2].first) + "; it is left out"));
}

/// Bytes of a conversation, in chunks or not: one message at each time.
std::string file_of(const std::vector<std::vector<std::uint64_t>>& chunks, bool packed = true) {
    std::string file(sim::mcap::magic);
    std::string channel = sim::mcap::channel_record({1, 0, "/wire/from_scanner", "scip", {}});
    for (const auto& times : chunks) {
        std::string records = std::exchange(channel, "");
        for (const std::uint64_t time : times)
            records += sim::mcap::message_record({1, 0, time, time, std::to_string(time)});
        const auto [first, last] = std::ranges::minmax(times);
        file += packed ? sim::mcap::chunk_record({first, last, records.size(), 0, "", records})
                       : records;
    }
    return file + sim::mcap::record(sim::mcap::Opcode::data_end, std::string(4, '\0'));
}

std::vector<std::string> texts(const ReadBack& back) {
    EXPECT_EQ(back.fault, "");
    EXPECT_THAT(back.warnings, IsEmpty());
    std::vector<std::string> texts;
    for (const sim::RecordedBytes& bytes : back.bytes())
        texts.push_back(bytes.bytes);
    return texts;
}

// The earliest chunk needs a channel that only one behind it in time describes.
TEST(Mcap, ComesInOrderOfTimeFromChunksInAnyOrder) {
    const std::vector<std::string> ordered{"1", "2", "3", "4", "5", "6", "7", "8", "9"};
    for (const bool packed : {true, false}) {
        EXPECT_EQ(texts(read_bytes(file_of({{7, 8, 9}, {1, 3, 2}, {6, 5, 4}}, packed))), ordered);
        EXPECT_EQ(texts(read_bytes(file_of({{1, 4, 7}, {2, 5, 8}, {9, 6, 3}}, packed))), ordered);
        EXPECT_EQ(texts(read_bytes(file_of({{9}, {1, 8}, {2, 7}, {3, 6}, {4, 5}}, packed))),
                  ordered);
    }
}

TEST(Mcap, PassesOverWhatIsEarlyUnread) {
    const TempDir directory;
    std::string bytes = bytes_of(ten_scans(directory, Compression::none, false));
    std::size_t fifth = 0;
    for (int n = 0; n < 5; ++n)
        fifth = bytes.find("\"timestamp\":", fifth + 1);
    ASSERT_NE(fifth, bytes.npos);
    bytes[fifth + 1] = 'T';  // its chunk cannot be read
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
    EXPECT_EQ(recording->warnings().size() + 1, read_bytes(bytes).warnings.size());
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
