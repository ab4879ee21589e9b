// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/gz_message.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "daemon/bridges/checked_pose.h"

namespace scipd::daemon {
namespace {

/// Goes through the fields of a Protocol Buffers message, by the wire format that its makers
/// document ("Encoding", protobuf.dev). Knows no message. Never reads beyond the bytes: what is
/// damaged ends the walk, and good() is false.
class ProtobufReader {
  public:
    /// The bytes must outlive this.
    explicit ProtobufReader(std::string_view bytes) : bytes_(bytes) {}

    /// Goes on to the next field. False: there is none, or the bytes are damaged.
    bool next();
    [[nodiscard]] bool good() const { return good_; }

    /// The number of the field that next() came to, and its value as each kind. Kinds that it is
    /// not of are zero or empty.
    [[nodiscard]] std::uint32_t field() const { return field_; }
    [[nodiscard]] std::int64_t integer() const { return integer_; }
    [[nodiscard]] double float64() const { return float64_; }
    /// A text, or a message in it.
    [[nodiscard]] std::string_view bytes() const { return within_; }

  private:
    std::uint64_t varint();
    std::string_view take(std::uint64_t size);

    std::string_view bytes_;
    bool good_ = true;
    std::uint32_t field_ = 0;
    std::int64_t integer_ = 0;
    double float64_ = 0.0;
    std::string_view within_;
};

enum WireType : unsigned { as_varint = 0, eight_bytes = 1, with_length = 2, four_bytes = 5 };

std::string_view ProtobufReader::take(std::uint64_t size) {
    if (size > bytes_.size()) {
        good_ = false;
        return {};
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
}

std::uint64_t ProtobufReader::varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        const std::string_view byte = take(1);
        if (byte.empty()) return 0;
        const auto bits = static_cast<unsigned char>(byte.front());
        value |= std::uint64_t{bits & 0x7fU} << shift;
        if ((bits & 0x80U) == 0) return value;
    }
    good_ = false;
    return 0;
}

bool ProtobufReader::next() {
    integer_ = 0;
    float64_ = 0.0;
    within_ = {};
    if (bytes_.empty() || !good_) return false;
    const std::uint64_t tag = varint();
    field_ = static_cast<std::uint32_t>(tag >> 3U);
    switch (tag & 7U) {
        case as_varint:
            integer_ = static_cast<std::int64_t>(varint());
            break;
        case eight_bytes: {
            std::uint64_t raw = 0;
            unsigned shift = 0;
            for (const char byte : take(8)) {
                raw |= std::uint64_t{static_cast<unsigned char>(byte)} << shift;
                shift += 8;
            }
            float64_ = std::bit_cast<double>(raw);
            break;
        }
        case with_length:
            within_ = take(varint());
            break;
        case four_bytes:
            (void)take(4);
            break;
        default:
            good_ = false;
    }
    return good_;
}

// A world of Gazebo has some thousands of models and links.
constexpr std::size_t most_poses = 100'000;
constexpr std::int64_t longest_s = 9'000'000'000;

sim::Expected<> damaged() {
    return sim::refuse("the message is damaged");
}

sim::Time read_time(std::string_view bytes) {
    sim::Time time{};
    for (ProtobufReader reader(bytes); reader.next();) {
        if (reader.field() == 1)
            time += std::chrono::seconds(std::clamp(reader.integer(), -longest_s, longest_s));
        if (reader.field() == 2)
            time +=
                sim::Time(std::clamp<std::int64_t>(reader.integer(), -1'000'000'000, 999'999'999));
    }
    return time;
}

struct Header {
    std::optional<sim::Time> time;
    std::string frame;
    std::string child;
};

/// One of the pairs of a header: a key and its values.
void read_pair(std::string_view bytes, Header& header) {
    std::string_view key;
    std::string_view value;
    for (ProtobufReader reader(bytes); reader.next();) {
        if (reader.field() == 1) key = reader.bytes();
        if (reader.field() == 2 && value.empty()) value = reader.bytes();
    }
    if (key == "frame_id") header.frame = value;
    if (key == "child_frame_id") header.child = value;
}

Header read_header(std::string_view bytes) {
    Header header;
    for (ProtobufReader reader(bytes); reader.next();) {
        if (reader.field() == 1) header.time = read_time(reader.bytes());
        if (reader.field() == 2) read_pair(reader.bytes(), header);
    }
    return header;
}

/// x, y, z (and w) stand in the fields from 2 on. What is left out is 0.
template <std::size_t Count>
std::array<double, Count> read_numbers(std::string_view bytes) {
    std::array<double, Count> numbers{};
    for (ProtobufReader reader(bytes); reader.next();) {
        const std::size_t index = std::size_t{reader.field()} - 2;
        if (index < Count) numbers[index] = reader.float64();
    }
    return numbers;
}

sim::Expected<> read_pose(std::string_view bytes, Heard& heard) {
    if (heard.poses.size() >= most_poses) return sim::refuse("poses are too many");
    HeardPose pose;
    std::array<double, 3> xyz_m{};
    std::array<double, 4> q{0.0, 0.0, 0.0, 1.0};
    ProtobufReader reader(bytes);
    while (reader.next()) {
        if (reader.field() == 1) pose.time = read_header(reader.bytes()).time;
        if (reader.field() == 2) pose.child = reader.bytes();
        if (reader.field() == 3) pose.id = static_cast<std::uint64_t>(reader.integer());
        if (reader.field() == 4) xyz_m = read_numbers<3>(reader.bytes());
        if (reader.field() == 5) q = read_numbers<4>(reader.bytes());
    }
    if (!reader.good()) return damaged();
    return checked_pose("pose of '" + pose.child + "'", xyz_m, q)
        .map([&](const sim::Pose& checked) {
            pose.parent_from_child = checked;
            heard.poses.push_back(pose);
        });
}

/// The stamp of a message holds for those of its poses that have none.
void stamp(Heard& heard, const std::optional<sim::Time>& time) {
    for (HeardPose& pose : heard.poses) {
        if (!pose.time) pose.time = time;
    }
}

sim::Expected<> read_poses(std::string_view bytes, Heard& heard) {
    Header header;
    ProtobufReader reader(bytes);
    while (reader.next()) {
        if (reader.field() == 1) header = read_header(reader.bytes());
        if (reader.field() != 2) continue;
        if (auto read = read_pose(reader.bytes(), heard); !read) return read;
    }
    if (!reader.good()) return damaged();
    stamp(heard, header.time);
    return {};
}

/// Its header and its pose have the numbers that those of a Pose_V have.
sim::Expected<> read_odometry(std::string_view bytes, Heard& heard) {
    if (auto read = read_poses(bytes, heard); !read) return read;
    if (heard.poses.size() != 1) return sim::refuse("the message has no pose");
    // It is of whoever the topic is of.
    heard.poses[0].child.clear();
    return {};
}

sim::Expected<> read_clock(std::string_view bytes, Heard& heard) {
    heard.clock = sim::Time{};
    ProtobufReader reader(bytes);
    while (reader.next()) {
        if (reader.field() == 4) heard.clock = read_time(reader.bytes());
    }
    if (!reader.good()) return damaged();
    return {};
}

struct Reading {
    std::string_view type;
    sim::Expected<> (*read)(std::string_view bytes, Heard& heard);
};

constexpr std::array readings{
    Reading{"Pose", read_pose},
    Reading{"Pose_V", read_poses},
    Reading{"Odometry", read_odometry},
    Reading{"Clock", read_clock},
};

const Reading* reading_of(std::string_view type) {
    const auto found = std::ranges::find(readings, plain_gz_type(type), &Reading::type);
    return found == readings.end() ? nullptr : &*found;
}

}  // namespace

std::string_view plain_gz_type(std::string_view type) {
    for (const std::string_view prefix : {"gz.msgs.", "ignition.msgs."}) {
        if (type.starts_with(prefix)) return type.substr(prefix.size());
    }
    return type;
}

bool is_readable_gz_type(std::string_view type) {
    return reading_of(type) != nullptr;
}

sim::Expected<Heard> read_gz_message(std::string_view type, std::string_view bytes) {
    const Reading* const reading = reading_of(type);
    if (reading == nullptr)
        return sim::refuse(std::string(type) + " holds no pose that scipd can read");
    Heard heard{.type = std::string(type), .poses = {}};
    const auto read = reading->read(bytes, heard);
    if (!read) return sim::refuse(heard.type + ": " + read.error().why);
    return heard;
}

}  // namespace scipd::daemon
