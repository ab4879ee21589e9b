// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/laser_recording.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/recording/file/byte_reader.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Each costs memory, and a hostile file may name a million.
constexpr std::size_t most_topics = 4096;

/// The fields of a message, one after the other. All numbers of scans have 32 bits.
class Fields {
  public:
    /// CDR begins with four bytes of its own, of which the second tells the order.
    Fields(std::string_view bytes, RosEncoding encoding)
        : cdr_(encoding == RosEncoding::cdr),
          order_(cdr_ && bytes.size() > 1 && (bytes[1] & 1) == 0 ? std::endian::big
                                                                 : std::endian::little),
          reader_(cdr_ ? bytes.substr(std::min<std::size_t>(bytes.size(), 4)) : bytes, order_),
          size_(reader_.rest().size()) {}

    [[nodiscard]] bool is_cdr() const { return cdr_; }
    [[nodiscard]] bool too_short() const { return reader_.too_short(); }

    std::uint32_t word() {
        align();
        return reader_.number<std::uint32_t>();
    }
    float real() { return std::bit_cast<float>(word()); }
    void skip_text() { reader_.skip(word()); }
    /// The count of elements that follow: a length that the bytes cannot hold reads past their end.
    std::uint32_t count() {
        const std::uint32_t count = word();
        if (count <= reader_.rest().size()) return count;
        reader_.skip(reader_.rest().size() + 1);
        return 0;
    }
    /// Appends them.
    std::size_t reals(std::vector<double>& values) {
        const std::uint32_t length = count();
        ByteReader list(reader_.take(std::uint64_t{length} * sizeof(float)), order_);
        while (!list.at_end())
            values.push_back(list.float32());
        return length;
    }

  private:
    /// CDR puts numbers at multiples of their size.
    void align() {
        if (cdr_) reader_.skip((sizeof(float) - (size_ - reader_.rest().size()) % 4) % 4);
    }

    bool cdr_;
    std::endian order_;
    ByteReader reader_;
    std::size_t size_;
};

/// The number of the message (ROS 1), its time, and the name of its frame.
std::optional<HostTime> read_header(Fields& fields) {
    if (!fields.is_cdr()) (void)fields.word();
    const std::uint32_t seconds = fields.word();
    const std::uint32_t nanoseconds = fields.word();
    fields.skip_text();
    if (seconds == 0 && nanoseconds == 0) return std::nullopt;
    return host_time_at(seconds, nanoseconds);
}

void read_single(Fields& fields, RecordedScan& scan) {
    (void)fields.reals(scan.ranges);
    (void)fields.reals(scan.intensities);
}

void read_echoes(Fields& fields, RecordedScan& scan) {
    const std::uint32_t steps = fields.count();
    for (std::uint32_t step = 0; step < steps && !fields.too_short(); ++step) {
        (void)fields.reals(scan.ranges);
        scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    }
    const std::uint32_t with_intensities = fields.count();
    for (std::uint32_t step = 0; step < with_intensities && !fields.too_short(); ++step)
        (void)fields.reals(scan.intensities);
}

/// Left out where a message cannot mean them.
void put_directions(double first_rad, double increment_rad, RecordedScan& scan) {
    constexpr double widest_rad = 3.2;
    const double size_rad = std::abs(increment_rad);
    const bool is_sane = std::isfinite(first_rad) && size_rad > 0.0 && size_rad < widest_rad;
    if (is_sane) scan.directions = {.first_rad = first_rad, .increment_rad = increment_rad};
}

}  // namespace

std::optional<LaserType> laser_type(std::string_view type_name) {
    if (type_name == "sensor_msgs/LaserScan" || type_name == "sensor_msgs/msg/LaserScan")
        return LaserType::laser_scan;
    if (type_name == "sensor_msgs/MultiEchoLaserScan" ||
        type_name == "sensor_msgs/msg/MultiEchoLaserScan")
        return LaserType::multi_echo_laser_scan;
    return std::nullopt;
}

Expected<LaserMessage> parse_laser(std::string_view bytes, LaserType type, RosEncoding encoding) {
    Fields fields(bytes, encoding);
    LaserMessage message;
    RecordedScan& scan = message.scan;
    scan.unit = RangeUnit::metres;
    scan.host_time = read_header(fields);
    const double first_rad = fields.real();
    (void)fields.real();  // the last angle
    const double increment_rad = fields.real();
    (void)fields.real();  // the time between two steps, and between two scans
    (void)fields.real();
    message.min_range_m = fields.real();
    message.max_range_m = fields.real();
    if (type == LaserType::laser_scan)
        read_single(fields, scan);
    else
        read_echoes(fields, scan);
    if (fields.too_short()) return refuse("the message ends before its last field");
    if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
        message.lost_intensities = std::exchange(scan.intensities, {}).size();
    put_directions(first_rad, increment_rad, scan);
    return message;
}

void LaserRecording::add_topic(std::uint32_t id, const RosTopic& topic) {
    const auto type = laser_type(topic.type);
    if (!type) return leave_out(topic.name, topic.type);
    if (topics_.contains(id)) return;
    if (streams().size() >= most_topics && !streams_by_name_.contains(topic.name)) {
        if (!std::exchange(too_many_, true))
            warn(file_.name() + ": has more than " + std::to_string(most_topics) +
                 " topics of scans; the others are left out");
        return;
    }
    // Several publishers of one topic are several connections of a bag.
    const auto [found, is_new] = streams_by_name_.try_emplace(topic.name, 0);
    if (is_new) found->second = add_stream({.name = topic.name, .type = topic.type});
    topics_[id] = {topic.name, found->second, *type, topic.encoding};
}

Expected<RecordedItem> LaserRecording::laser_item(std::uint32_t id, HostTime logged,
                                                  std::string_view bytes) {
    Topic& topic = topics_.at(id);
    auto message = parse_laser(bytes, topic.type, topic.encoding);
    if (!message) return refuse(quote(topic.name) + ": " + message.error().why);
    ScannerIdentity& identity = stream(topic.stream).identity;
    if (!identity.max_range_m && std::isfinite(message->max_range_m) &&
        message->max_range_m > message->min_range_m) {
        identity.min_range_m = message->min_range_m;
        identity.max_range_m = message->max_range_m;
    }
    if (message->lost_intensities > 0 && !std::exchange(topic.lost_intensities, true))
        warn(file_.name() + ": " + quote(topic.name) + " has scans with " +
             std::to_string(message->lost_intensities) + " intensities for " +
             std::to_string(message->scan.ranges.size()) +
             " ranges; such intensities are left out");
    // Within these, sums and differences of two times fit.
    constexpr HostTime latest{std::chrono::nanoseconds(std::int64_t{1} << 62)};
    const HostTime sane = std::clamp(logged, HostTime{}, latest);
    std::optional<HostTime>& time = message->scan.host_time;
    const bool stamped = time.has_value();
    if (stamped) topic.stamp_after_log = *time - sane;
    if (!stamped) time = sane + topic.stamp_after_log;
    return RecordedItem{topic.stream, std::move(message->scan), logged, stamped};
}

}  // namespace scipd::sim
