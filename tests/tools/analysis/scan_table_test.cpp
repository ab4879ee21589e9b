// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The table of scans: codes beside distances, repeated scans, several recordings, and the same
// scans in three formats.
#include "tools/analysis/scan_table.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include <gmock/gmock.h>

#include "sim/recording/create_recording.h"
#include "tests/support/temp_dir.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

using sim::RecordedItem;
using sim::RecordedScan;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsNan;
using testing::ThrowsMessage;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Code mm_code = codes::distance;

/// A recording of these scans.
class Scans : public sim::Recording {
  public:
    explicit Scans(std::vector<RecordedScan> scans, std::string model = "UST-10LX",
                   bool stamped = false)
        : Recording("test"), scans_(std::move(scans)), stamped_(stamped) {
        add_stream({.name = "scanner", .type = "test", .identity = {.model = std::move(model)}});
    }

  private:
    Next do_next() override {
        if (next_ == scans_.size()) return std::nullopt;
        RecordedItem item{0, scans_[next_++]};
        item.stamped = stamped_;
        return item;
    }

    std::vector<RecordedScan> scans_;
    bool stamped_;
    std::size_t next_ = 0;
};

RecordedScan scan(std::vector<double> ranges, std::optional<std::uint32_t> stamp_ms = {}) {
    return {.stamp_ms = stamp_ms, .ranges = std::move(ranges)};
}

RecordedScan metres(std::vector<double> ranges) {
    RecordedScan metres = scan(std::move(ranges));
    metres.unit = sim::RangeUnit::metres;
    return metres;
}

RecordedScan at_second(RecordedScan scan, int second) {
    scan.host_time = sim::host_time_at(1'700'000'000 + second);
    return scan;
}

ScanTable read(Scans scans, ScanTable table = {}) {
    read_scans(scans, "file", {}, table);
    return table;
}

std::vector<Code> classes_of(const ScanTable& table) {
    std::vector<Code> classes;
    for (const Code code : table.codes)
        classes.push_back(class_of(code));
    return classes;
}

TEST(ScanTable, KeepsTheNumberOfEachCode) {
    const ScanTable table = read(Scans({scan({1000, 0, 1, 6, 19, 20, 65532, 65533})}));
    EXPECT_THAT(table.codes, ElementsAre(mm_code, 0, 1, 6, 19, mm_code, mm_code, 65533));
    EXPECT_THAT(classes_of(table), ElementsAre(mm_code, codes::nothing, codes::nothing, 6, 19,
                                               mm_code, mm_code, codes::nothing));
    EXPECT_TRUE(std::isnan(table.range_mm(0, 1)));
    EXPECT_EQ(table.range_mm(0, 6), 65532);
    EXPECT_EQ(name_of_code(table.code(0, 1)), "no distance");
    EXPECT_EQ(name_of_code(table.code(0, 3)), "6");
    EXPECT_TRUE(table.has_codes);
}

TEST(ScanTable, HasCodesBeyondTheLimitsOfTheScanner) {
    ScanTable table{.identity = {.min_range_m = 0.06, .max_range_m = 30}};
    table.add(scan({59, 60, 30'000, 30'001, 65533}));
    EXPECT_THAT(table.codes, ElementsAre(59, mm_code, mm_code, 30'001, 65533));
    EXPECT_EQ(class_of(59), codes::nothing);
    EXPECT_EQ(class_of(30'001), codes::nothing);
    table.limit(20, 29'000);
    EXPECT_THAT(table.codes, ElementsAre(59, mm_code, 30'000, 30'001, 65533));
    EXPECT_TRUE(std::isnan(table.range_mm(0, 2)));
}

TEST(ScanTable, ReadsCodesInMetres) {
    const ScanTable table =
        read(Scans({metres({1.5F, std::nan(""), infinity, -infinity, 65.533F, 0.0, 0.006F})}));
    EXPECT_THAT(table.codes, ElementsAre(mm_code, codes::nothing, codes::too_far, codes::too_near,
                                         65533, codes::nothing, 6));
    EXPECT_EQ(table.range_mm(0, 0), 1500);
    EXPECT_TRUE(table.has_codes);
}

TEST(ScanTable, HasNoCodesOfMetresWithoutThem) {
    const ScanTable table = read(Scans({metres({1.234F, infinity, std::nan("")})}));
    EXPECT_FALSE(table.has_codes);
    EXPECT_TRUE(table.whole_mm);
    EXPECT_EQ(table.range_mm(0, 0), 1234);
    EXPECT_FALSE(read(Scans({metres({1.2345F})})).whole_mm);
}

TEST(ScanTable, LeavesOutScansThatCameTwice) {
    const ScanTable table = read(Scans(
        {scan({500, 600}, 1), scan({500, 600}, 1), scan({500, 600}, 2), scan({501, 600}, 3)}));
    EXPECT_EQ(table.doubles, 1U);
    EXPECT_THAT(table.ranges_mm, ElementsAre(500, 600, 500, 600, 501, 600));
    EXPECT_EQ(table.times.size(), 3U);
}

TEST(ScanTable, KnowsDoublesWithoutStampsByTheirReadings) {
    const ScanTable table = read(Scans({scan({500, 600}), scan({500, 600}), scan({500, 601})}));
    EXPECT_EQ(table.doubles, 1U);
    EXPECT_EQ(table.scans(), 2U);
    const RecordedScan with_none = metres({1.5, std::nan(""), 2.5});
    EXPECT_EQ(read(Scans({with_none, with_none})).doubles, 1U);
    RecordedScan lit = scan({500, 600});
    lit.intensities = {1000, 1000};
    RecordedScan brighter = lit;
    brighter.intensities[1] = 1001;
    EXPECT_EQ(read(Scans({lit, brighter})).doubles, 0U);
}

// Scanners without noise repeat their readings; a recorder that only logs a topic does as well.
TEST(ScanTable, TakesEqualScansWithStampsOfTheirOwnForTwo) {
    const std::vector<RecordedScan> equal{at_second(metres({1.5, 2.5}), 0),
                                          at_second(metres({1.5, 2.5}), 1),
                                          at_second(metres({1.5, 2.5}), 1)};
    const ScanTable stamped = read(Scans(equal, "", true));
    EXPECT_EQ(stamped.scans(), 2U);
    EXPECT_EQ(stamped.doubles, 1U);
    EXPECT_EQ(read(Scans(equal, "", false)).scans(), 1U);
}

// A scanner whose clock stands still.
TEST(ScanTable, TakesOtherReadingsForAnotherScanWhateverTheStamp) {
    EXPECT_EQ(read(Scans({scan({500, 600}, 7), scan({500, 601}, 7)})).scans(), 2U);
}

TEST(ScanTable, CountsScansOfOtherSteps) {
    RecordedScan elsewhere = scan({1000, 1000}, 85);
    elsewhere.directions.first_step = 4;
    RecordedScan first = scan({1000, 1000}, 10);
    first.directions.first_step = 0;
    testing::internal::CaptureStderr();
    const ScanTable table =
        read(Scans({first, scan({1000, 1000}, 35), scan({1000}, 60), elsewhere}));
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "file: 2 scans have other steps than the first of 2, and are left out\n");
    EXPECT_EQ(table.scans(), 2U);
    EXPECT_EQ(table.odd_ones, 2U);
}

TEST(ScanTable, FollowsTheClockWhereItWraps) {
    ScanTable table;
    table.add(scan({1000}, 0xFFFFF0));
    table.add(scan({1001}, 9));
    EXPECT_NEAR(*table.times[1].stamp_s - *table.times[0].stamp_s, 0.025, 1e-9);
}

TEST(ScanTable, KnowsThePeriodByTheHostsClock) {
    const ScanTable table = read(Scans({at_second(scan({1000}), 3), at_second(scan({1001}), 5),
                                        at_second(scan({1000}), 7), at_second(scan({1002}), 9)}));
    EXPECT_DOUBLE_EQ(table.period_s(), 2.0);
    EXPECT_EQ(read(Scans({scan({1000}), scan({1001})})).period_s(), 0.0);
}

TEST(ScanTable, KeepsTheFirstScanOfEachRecording) {
    const ScanTable table = read(Scans({scan({500, 600})}), read(Scans({scan({500, 600})})));
    EXPECT_EQ(table.scans(), 2U);
    EXPECT_THAT(table.begins, ElementsAre(0, 1, 2));
    EXPECT_EQ(table.files, "file, file");
}

TEST(ScanTable, ChoosesTheEcho) {
    RecordedScan echoes = scan({500, 900, 600});
    echoes.intensities = {100, 400, 300};
    echoes.echo_ends = {2, 3, 3};
    ScanTable first;
    first.add(echoes);
    EXPECT_EQ(first.range_mm(0, 0), 500);
    EXPECT_EQ(first.code(0, 2), codes::nothing);
    ScanTable brightest{.echo = Echo::brightest};
    brightest.add(echoes);
    EXPECT_EQ(brightest.range_mm(0, 0), 900);
    EXPECT_EQ(brightest.intensity(0, 0), 400);
    EXPECT_EQ(brightest.range_mm(0, 1), 600);
}

TEST(ScanTable, TakesRecordingsWithIntensitiesAndWithout) {
    RecordedScan lit = scan({500, 600});
    lit.intensities = {1200, std::nan("")};
    const ScanTable dark = read(Scans({scan({500, 600})}));
    EXPECT_FALSE(dark.has_intensities());
    EXPECT_TRUE(std::isnan(dark.intensity(0, 1)));
    const ScanTable behind = read(Scans({lit}), dark);
    EXPECT_TRUE(behind.has_intensities());
    EXPECT_THAT(behind.intensities, ElementsAre(IsNan(), IsNan(), 1200, IsNan()));
    const ScanTable before = read(Scans({scan({500, 600})}), read(Scans({lit})));
    EXPECT_THAT(before.intensities, ElementsAre(1200, IsNan(), IsNan(), IsNan()));
}

TEST(ScanTable, RefusesWhatIsNotOfOneScanner) {
    const ScanTable first = read(Scans({scan({500, 600})}));
    EXPECT_THAT(
        [&] { (void)read(Scans({scan({500})}), first); },
        ThrowsMessage<WrongInput>("file: 1 scans have other steps than the first of 2; name "
                                  "recordings of one scanner with the same steps"));
    const std::vector<RecordedScan> scans{scan({500, 600})};
    EXPECT_THAT([&] { (void)read(Scans(scans, "UTM-30LX"), first); },
                ThrowsMessage<WrongInput>(HasSubstr("file: is of a UTM-30LX, the recording before "
                                                    "of a UST-10LX")));
    EXPECT_THAT([] { (void)read(Scans({})); }, ThrowsMessage<WrongInput>("file: holds no scans"));
}

// The formats, of which the bag is written by ROS' description of it.

template <class... Values>
std::string raw(Values... values) {
    std::string bytes;
    (bytes.append(std::bit_cast<std::array<char, sizeof(Values)>>(values).data(), sizeof(Values)),
     ...);
    return bytes;
}

std::string sized(const std::string& bytes) {
    return raw(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

std::string bag_record(const std::vector<std::string>& fields, const std::string& data) {
    std::string head;
    for (const std::string& field : fields)
        head += sized(field);
    return sized(head) + sized(data);
}

constexpr std::uint32_t begin_s = 1'700'000'000;
constexpr std::uint32_t period_ns = 25'000'000;

std::string laser_scan(std::uint32_t number, const std::vector<float>& ranges_m,
                       const std::vector<float>& intensities) {
    const auto last = static_cast<float>(ranges_m.size() - 1);
    std::string message = raw(number, begin_s, number * period_ns) + sized("laser") +
                          raw(-1.0F, -1.0F + 0.25F * last, 0.25F, 0.0F, 0.025F, 0.023F, 60.0F);
    for (const auto* const values : {&ranges_m, &intensities}) {
        message += raw(static_cast<std::uint32_t>(values->size()));
        for (const float value : *values)
            message += raw(value);
    }
    return message;
}

std::string bag_of(const std::vector<std::string>& messages) {
    std::string chunk = bag_record({"op=\x07", "conn=" + raw(0U), "topic=/scan"},
                                   sized("topic=/scan") + sized("type=sensor_msgs/LaserScan"));
    for (std::uint32_t i = 0; i < messages.size(); ++i)
        chunk += bag_record({"op=\x02", "conn=" + raw(0U), "time=" + raw(begin_s, i * period_ns)},
                            messages[i]);
    return "#ROSBAG V2.0\n" +
           bag_record({"op=\x03", "index_pos=" + raw(std::uint64_t{0}), "conn_count=" + raw(0U),
                       "chunk_count=" + raw(0U)},
                      std::string(4027, ' ')) +
           bag_record({"op=\x05", "compression=none",
                       "size=" + raw(static_cast<std::uint32_t>(chunk.size()))},
                      chunk);
}

/// What a UTM-30LX sent in three scans, the last two of them alike.
const std::vector<std::vector<double>> sent_mm{{1234, 1, 2, 3, 5, 1, 1, 8, 59'999},
                                               {1236, 1, 2, 3, 5, 1, 1, 7, 60'000},
                                               {1236, 1, 2, 3, 5, 1, 1, 7, 60'000}};
const std::vector<double> sent_light{2000, 0, 0, 0, 0, 0, 0, 0, 150};

/// As drivers publish it: c / 1000 m for most codes, and what REP 117 has in place of some.
std::vector<float> published_m(const std::vector<double>& mm) {
    std::vector<float> ranges_m;
    for (const double value : mm)
        ranges_m.push_back(static_cast<float>(value / 1000.0));
    ranges_m[2] = -infinity;
    ranges_m[5] = infinity;
    ranges_m[6] = std::nanf("");
    return ranges_m;
}

ScanTable table_in(const std::filesystem::path& file) {
    ScanTable table;
    read_scans(*open_recorded(file.string()), file.string(), {}, table);
    return table;
}

class Formats : public testing::Test {
  protected:
    std::filesystem::path written(const std::string& name) {
        const sim::ScannerIdentity identity{.model = "UTM-30LX",
                                            .serial = "H1",
                                            .firmware = "1",
                                            .min_range_m = 0.023,
                                            .max_range_m = 60,
                                            .steps_per_turn = 25,
                                            .front_step = 4,
                                            .rpm = 2400};
        const auto file = folder_.path() / name;
        const auto writer = sim::create_recording(file, identity, {"test", "1"});
        for (std::uint32_t i = 0; i < sent_mm.size(); ++i) {
            RecordedScan sent{.host_time = sim::host_time_at(begin_s, i * period_ns),
                              .stamp_ms = 1000 + 25 * i,
                              .ranges = sent_mm[i],
                              .intensities = sent_light};
            sent.directions.first_step = 0;
            writer->write(sent);
        }
        writer->finish();
        return file;
    }

    tests::TempDir folder_;
};

TEST_F(Formats, GiveOneTable) {
    const ScanTable mcap = table_in(written("scans.mcap"));
    EXPECT_THAT(mcap.codes, ElementsAre(mm_code, 1, 2, 3, 5, 1, 1, 8, mm_code, mm_code, 1, 2, 3, 5,
                                        1, 1, 7, mm_code, mm_code, 1, 2, 3, 5, 1, 1, 7, mm_code));
    EXPECT_EQ(mcap.range_mm(1, 0), 1236);
    EXPECT_EQ(mcap.range_mm(1, 8), 60'000);
    EXPECT_EQ(mcap.intensity(1, 8), 150);
    EXPECT_DOUBLE_EQ(mcap.period_s(), 0.025);

    const ScanTable ubh = table_in(written("scans.ubh"));
    EXPECT_EQ(ubh.codes, mcap.codes);
    EXPECT_EQ(ubh.directions.first_step, mcap.directions.first_step);

    std::vector<std::string> messages;
    const std::vector<float> light(sent_light.begin(), sent_light.end());
    for (const auto& mm : sent_mm)
        messages.push_back(
            laser_scan(static_cast<std::uint32_t>(messages.size()), published_m(mm), light));
    const ScanTable bag = table_in(folder_.write("scans.bag", bag_of(messages)));
    EXPECT_EQ(bag.code(0, 1), 1);
    EXPECT_EQ(bag.code(0, 2), codes::too_near);  // of which the bag does not say the number
    EXPECT_EQ(bag.code(0, 3), 3);
    EXPECT_EQ(bag.code(0, 5), codes::too_far);
    EXPECT_EQ(bag.code(0, 7), 8);
    auto told = classes_of(mcap);
    for (std::size_t scan = 0; scan < 3; ++scan)
        told[9 * scan + 2] = codes::nothing;
    EXPECT_THAT(classes_of(bag), ElementsAreArray(told));

    for (const ScanTable* table : {&ubh, &bag}) {
        ASSERT_EQ(table->scans(), 3U);
        EXPECT_EQ(table->doubles, 0U);
        EXPECT_TRUE(table->has_codes);
        EXPECT_TRUE(table->whole_mm);
        EXPECT_DOUBLE_EQ(table->period_s(), mcap.period_s());
        for (std::size_t i = 0; i < mcap.ranges_mm.size(); ++i) {
            EXPECT_EQ(is_distance(table->ranges_mm[i]), is_distance(mcap.ranges_mm[i])) << i;
            if (!is_distance(mcap.ranges_mm[i])) continue;
            EXPECT_EQ(table->ranges_mm[i], mcap.ranges_mm[i]) << i;
            EXPECT_EQ(table->intensities[i], mcap.intensities[i]) << i;
        }
    }
}

}  // namespace
}  // namespace scipd::tools
