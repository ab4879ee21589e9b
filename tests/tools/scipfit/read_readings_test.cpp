// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings become readings: doubles go, codes stay, what does not belong together is refused.
#include "tools/scipfit/read_readings.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tools/options.h"

namespace scipd::tools {
namespace {

using sim::RecordedItem;
using sim::RecordedScan;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A recording of these scans.
class Scans : public sim::Recording {
  public:
    explicit Scans(std::vector<RecordedScan> scans, std::string model = "UST-10LX")
        : Recording("test"), scans_(std::move(scans)) {
        add_stream({.name = "scanner", .type = "test", .identity = {.model = std::move(model)}});
    }

  private:
    Next do_next() override {
        if (next_ == scans_.size()) return std::nullopt;
        return RecordedItem{0, scans_[next_++]};
    }

    std::vector<RecordedScan> scans_;
    std::size_t next_ = 0;
};

RecordedScan scan(std::vector<double> ranges, std::optional<std::uint32_t> stamp_ms = {}) {
    return {.stamp_ms = stamp_ms, .ranges = std::move(ranges)};
}

Readings read(Scans scans, Readings readings = {}) {
    add_scans(scans, "file", "", readings);
    return readings;
}

TEST(ReadReadings, LeavesOutScansThatCameTwice) {
    const Readings readings = read(Scans(
        {scan({500, 600}, 1), scan({500, 600}, 1), scan({500, 600}, 2), scan({501, 600}, 3)}));
    EXPECT_EQ(readings.doubles, 1U);
    EXPECT_THAT(readings.mm, ElementsAre(500, 600, 500, 600, 501, 600));
}

TEST(ReadReadings, KnowsDoublesWithoutStampsByWhatTheySay) {
    const Readings readings = read(Scans({scan({500, 600}), scan({500, 600}), scan({500, 601})}));
    EXPECT_EQ(readings.doubles, 1U);
    EXPECT_EQ(readings.scans(), 2U);
}

TEST(ReadReadings, KeepsTheFirstScanOfEachRecording) {
    const Readings readings = read(Scans({scan({500, 600})}), read(Scans({scan({500, 600})})));
    EXPECT_EQ(readings.scans(), 2U);
    EXPECT_THAT(readings.begins, ElementsAre(0, 1, 2));
}

TEST(ReadReadings, TakesMetresAsMillimetresAndNoCodes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    RecordedScan metres = scan({1.234, infinity, std::nan("")});
    metres.unit = sim::RangeUnit::metres;
    const Readings readings = read(Scans({metres}));
    EXPECT_FALSE(readings.has_codes);
    EXPECT_TRUE(readings.whole_mm);
    EXPECT_THAT(readings.mm, ElementsAre(1234, no_value, no_value));
}

TEST(ReadReadings, MakesCodesOfWhatIsNoDistance) {
    Readings readings = read(Scans({scan({19, 20, 30000, 65533})}));
    apply_limits(20, 30000, readings);
    EXPECT_EQ(code_of(readings.mm[0]), 19U);
    EXPECT_TRUE(is_distance(readings.mm[1]));
    EXPECT_TRUE(is_distance(readings.mm[2]));
    EXPECT_EQ(code_of(readings.mm[3]), 65533U);
}

TEST(ReadReadings, TakesRecordingsWithIntensitiesAndWithout) {
    RecordedScan lit = scan({500, 600});
    lit.intensities = {1200, std::nan("")};
    const Readings behind = read(Scans({lit}), read(Scans({scan({500, 600})})));
    EXPECT_TRUE(behind.has_intensities);
    EXPECT_THAT(behind.intensity, ElementsAre(0, 0, 1200, 0));
    const Readings before = read(Scans({scan({500, 600})}), read(Scans({lit})));
    EXPECT_TRUE(before.has_intensities);
    EXPECT_THAT(before.intensity, ElementsAre(1200, 0, 0, 0));
}

TEST(ReadReadings, RefusesWhatIsNotOfOneScanner) {
    const Readings first = read(Scans({scan({500, 600})}));
    EXPECT_THAT([&] { (void)read(Scans({scan({500})}), first); },
                ThrowsMessage<WrongInput>(HasSubstr("file: has scans of 1 steps after others of "
                                                    "2; name recordings of one scanner")));
    const std::vector<RecordedScan> scans{scan({500, 600})};
    EXPECT_THAT([&] { (void)read(Scans(scans, "UTM-30LX"), first); },
                ThrowsMessage<WrongInput>(HasSubstr("file: is of a UTM-30LX, the recording before "
                                                    "of a UST-10LX")));
    EXPECT_THAT([] { (void)read(Scans({})); }, ThrowsMessage<WrongInput>("file: holds no scans"));
}

}  // namespace
}  // namespace scipd::tools
