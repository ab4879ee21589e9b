// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/laser_recording.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace scipd::tests {
namespace {

using sim::LaserType;
using sim::RosEncoding;
using testing::ElementsAre;

/// Writes messages as ROS does, told apart by an encoding and an order.
class MessageWriter {
  public:
    explicit MessageWriter(RosEncoding encoding, std::endian order = std::endian::little)
        : cdr_(encoding == RosEncoding::cdr), order_(order) {}

    void word(std::uint32_t value) {
        while (cdr_ && body_.size() % 4 != 0)
            body_.push_back('\0');
        for (int i = 0; i < 4; ++i) {
            const int shift = order_ == std::endian::little ? 8 * i : 8 * (3 - i);
            body_.push_back(static_cast<char>(value >> shift & 0xFF));
        }
    }
    void real(float value) { word(std::bit_cast<std::uint32_t>(value)); }
    void text(const std::string& text) {
        word(static_cast<std::uint32_t>(text.size() + (cdr_ ? 1 : 0)));
        body_ += text;
        if (cdr_) body_.push_back('\0');
    }
    void reals(const std::vector<float>& values) {
        word(static_cast<std::uint32_t>(values.size()));
        for (const float value : values)
            real(value);
    }
    /// Until the ranges.
    void begin() {
        if (!cdr_) word(7);
        word(1'700'000'000);
        word(500);
        text("laser");
        for (const float value : {-1.5F, 1.5F, 0.25F, 0.0F, 0.025F, 0.1F, 30.0F})
            real(value);
    }
    [[nodiscard]] std::string bytes() const {
        const bool little = order_ == std::endian::little;
        return (cdr_ ? std::string{'\0', little ? '\1' : '\0', '\0', '\0'} : "") + body_;
    }

  private:
    bool cdr_;
    std::endian order_;
    std::string body_;
};

struct Form {
    RosEncoding encoding;
    std::endian order;
};
const std::vector<Form> forms = {{RosEncoding::ros1, std::endian::little},
                                 {RosEncoding::cdr, std::endian::little},
                                 {RosEncoding::cdr, std::endian::big}};

TEST(LaserMessage, IsReadInEachForm) {
    for (const auto& [encoding, order] : forms) {
        MessageWriter writer(encoding, order);
        writer.begin();
        writer.reals({1.5F, std::numeric_limits<float>::infinity(), 2.5F});
        writer.reals({10, 20, 30});
        const auto message = parse_laser(writer.bytes(), LaserType::laser_scan, encoding);
        ASSERT_TRUE(message) << message.error().why;
        const auto& scan = message->scan;
        EXPECT_EQ(scan.host_time,
                  sim::HostTime(std::chrono::nanoseconds(1'700'000'000'000'000'500)));
        EXPECT_EQ(scan.unit, sim::RangeUnit::metres);
        EXPECT_THAT(scan.ranges, ElementsAre(1.5, std::numeric_limits<double>::infinity(), 2.5));
        EXPECT_THAT(scan.intensities, ElementsAre(10, 20, 30));
        EXPECT_EQ(scan.directions.first_rad, -1.5);
        EXPECT_EQ(scan.directions.increment_rad, 0.25);
        EXPECT_FLOAT_EQ(static_cast<float>(message->min_range_m), 0.1F);
        EXPECT_EQ(message->max_range_m, 30.0);
    }
}

TEST(LaserMessage, KeepsAllEchoes) {
    for (const auto& [encoding, order] : forms) {
        MessageWriter writer(encoding, order);
        writer.begin();
        writer.word(3);
        writer.reals({1.5F, 2.0F});
        writer.reals({});
        writer.reals({3.0F});
        writer.word(3);
        writer.reals({10, 20});
        writer.reals({});
        writer.reals({30});
        const auto message =
            parse_laser(writer.bytes(), LaserType::multi_echo_laser_scan, encoding);
        ASSERT_TRUE(message) << message.error().why;
        EXPECT_EQ(message->scan.steps(), 3U);
        EXPECT_THAT(message->scan.ranges_of(0), ElementsAre(1.5, 2.0));
        EXPECT_THAT(message->scan.ranges_of(1), ElementsAre());
        EXPECT_THAT(message->scan.intensities_of(2), ElementsAre(30));
    }
}

TEST(LaserMessage, IsRefusedWhereItEnds) {
    for (const auto& [encoding, order] : forms) {
        MessageWriter writer(encoding, order);
        writer.begin();
        writer.reals({1, 2, 3});
        writer.reals({});
        const std::string bytes = writer.bytes();
        ASSERT_TRUE(parse_laser(bytes, LaserType::laser_scan, encoding));
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(parse_laser(bytes.substr(0, size), LaserType::laser_scan, encoding));
    }
}

TEST(LaserMessage, RefusesALengthBeyondItsBytes) {
    MessageWriter writer(RosEncoding::cdr);
    writer.begin();
    writer.word(0xFFFFFFFF);
    for (const auto type : {LaserType::laser_scan, LaserType::multi_echo_laser_scan})
        EXPECT_FALSE(parse_laser(writer.bytes(), type, RosEncoding::cdr));
}

TEST(LaserMessage, LeavesOutIntensitiesOfOtherCount) {
    MessageWriter writer(RosEncoding::ros1);
    writer.begin();
    writer.reals({1, 2, 3});
    writer.reals({1, 2});
    const auto message = parse_laser(writer.bytes(), LaserType::laser_scan, RosEncoding::ros1);
    ASSERT_TRUE(message);
    EXPECT_THAT(message->scan.ranges, ElementsAre(1, 2, 3));
    EXPECT_TRUE(message->scan.intensities.empty());
    EXPECT_EQ(message->lost_intensities, 2U);
}

TEST(LaserMessage, HasNamesInBothRos) {
    EXPECT_EQ(sim::laser_type("sensor_msgs/LaserScan"), LaserType::laser_scan);
    EXPECT_EQ(sim::laser_type("sensor_msgs/msg/MultiEchoLaserScan"),
              LaserType::multi_echo_laser_scan);
    EXPECT_EQ(sim::laser_type("sensor_msgs/PointCloud2"), std::nullopt);
}

}  // namespace
}  // namespace scipd::tests
