// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/ros_cdr.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "daemon/bridges/checked_pose.h"

namespace scipd::daemon {
namespace {

/// Reads values from the bytes of a DDS message: CDR in its plain forms, by "Extensible and Dynamic
/// Topic Types for DDS" 1.3, 7.4 and 7.6.3. Knows no message. Never reads beyond the bytes: from
/// the first value that is not there on, all are zero or empty, and good() is false.
class CdrReader {
  public:
    /// The bytes of a message with their header of four bytes, which tells the form. They must
    /// outlive this.
    explicit CdrReader(std::string_view message);

    std::int32_t int32() { return static_cast<std::int32_t>(uint32()); }
    std::uint32_t uint32();
    double float64();
    template <std::size_t Count>
    std::array<double, Count> float64s() {
        std::array<double, Count> values{};
        for (double& value : values)
            value = float64();
        return values;
    }
    std::string text();

    [[nodiscard]] bool good() const { return good_; }

  private:
    template <class Value>
    Value take();
    std::string_view bytes(std::size_t count, std::size_t alignment);

    std::string_view body_;
    std::size_t at_ = 0;
    std::size_t widest_alignment_ = 8;
    bool little_endian_ = true;
    bool good_ = true;
};

constexpr std::size_t header_size = 4;

// Table 60 of the specification, the identifiers of plain encodings. Their lowest bit tells the
// order of bytes.
constexpr unsigned cdr = 0x0000;
constexpr unsigned cdr2 = 0x0006;

CdrReader::CdrReader(std::string_view message) {
    if (message.size() < header_size) {
        good_ = false;
        return;
    }
    const auto high = static_cast<unsigned char>(message[0]);
    const auto low = static_cast<unsigned char>(message[1]);
    const unsigned encoding = high * 256U + low;
    little_endian_ = encoding % 2 == 1;
    good_ = encoding / 2 == cdr / 2 || encoding / 2 == cdr2 / 2;
    if (encoding / 2 == cdr2 / 2) widest_alignment_ = 4;
    body_ = message.substr(header_size);
}

std::string_view CdrReader::bytes(std::size_t count, std::size_t alignment) {
    const std::size_t step = std::min(alignment, widest_alignment_);
    const std::size_t begin = (at_ + step - 1) / step * step;
    if (!good_ || begin > body_.size() || count > body_.size() - begin) {
        good_ = false;
        return {};
    }
    at_ = begin + count;
    return body_.substr(begin, count);
}

template <class Value>
Value CdrReader::take() {
    std::array<char, sizeof(Value)> raw{};
    const std::string_view from = bytes(raw.size(), raw.size());
    std::ranges::copy(from, raw.begin());
    if (little_endian_ != (std::endian::native == std::endian::little)) std::ranges::reverse(raw);
    return std::bit_cast<Value>(raw);
}

std::uint32_t CdrReader::uint32() {
    return take<std::uint32_t>();
}

double CdrReader::float64() {
    return take<double>();
}

// The size counts the zero at the end.
std::string CdrReader::text() {
    const std::uint32_t size = uint32();
    const std::string_view with_end = bytes(size, 1);
    return std::string(with_end.substr(0, with_end.find('\0')));
}

// A message of all frames of a robot has tens of them.
constexpr std::uint32_t most_transforms = 10'000;

struct Header {
    std::optional<sim::Time> time;
    std::string frame;
};

/// Zero stands for no time: nobody has set it.
std::optional<sim::Time> read_time(CdrReader& reader) {
    const std::int32_t whole_s = reader.int32();
    const std::uint32_t rest_ns = reader.uint32();
    if (whole_s == 0 && rest_ns == 0) return std::nullopt;
    return std::chrono::seconds(whole_s) + sim::Time(rest_ns);
}

Header read_header(CdrReader& reader) {
    Header header{.time = read_time(reader), .frame = {}};
    header.frame = reader.text();
    return header;
}

sim::Expected<sim::Pose> read_pose(CdrReader& reader, const std::string& what) {
    const auto xyz_m = reader.float64s<3>();
    const auto q = reader.float64s<4>();
    if (!reader.good()) return sim::refuse("the message ends too early, or is no plain CDR");
    return checked_pose(what, xyz_m, q);
}

sim::Expected<HeardPose> read_stamped(CdrReader& reader, bool names_child) {
    const Header header = read_header(reader);
    const std::string child = names_child ? reader.text() : std::string();
    return read_pose(reader, "pose").map([&](const sim::Pose& pose) {
        return HeardPose{
            .parent = header.frame, .child = child, .time = header.time, .parent_from_child = pose};
    });
}

sim::Expected<> read_pose_stamped(CdrReader& reader, Heard& heard) {
    return read_stamped(reader, false).map([&](const HeardPose& pose) {
        heard.poses.push_back(pose);
    });
}

sim::Expected<> read_transform(CdrReader& reader, Heard& heard) {
    return read_stamped(reader, true).map([&](const HeardPose& pose) {
        heard.poses.push_back(pose);
    });
}

sim::Expected<> read_odometry(CdrReader& reader, Heard& heard) {
    return read_stamped(reader, true).and_then([&](HeardPose pose) -> sim::Expected<> {
        (void)reader.float64s<36>();  // the covariance
        const auto linear = reader.float64s<3>();
        const auto angular = reader.float64s<3>();
        if (!reader.good()) return sim::refuse("the message ends too early");
        pose.velocity = velocity_in_parent(pose.parent_from_child.rotation, linear, angular);
        heard.poses.push_back(pose);
        return {};
    });
}

sim::Expected<> read_transforms(CdrReader& reader, Heard& heard) {
    const std::uint32_t count = reader.uint32();
    if (count > most_transforms) return sim::refuse("transforms are too many");
    for (std::uint32_t i = 0; i < count; ++i) {
        if (auto read = read_transform(reader, heard); !read) return read;
    }
    if (!reader.good()) return sim::refuse("the message ends too early");
    return {};
}

sim::Expected<> read_clock(CdrReader& reader, Heard& heard) {
    heard.clock = read_time(reader).value_or(sim::Time{});
    if (!reader.good()) return sim::refuse("the message ends too early");
    return {};
}

struct Reading {
    std::string_view type;
    sim::Expected<> (*read)(CdrReader& reader, Heard& heard);
};

// What follows a pose in PoseWithCovarianceStamped moves nothing.
constexpr std::array readings{
    Reading{"nav_msgs/Odometry", read_odometry},
    Reading{"geometry_msgs/PoseStamped", read_pose_stamped},
    Reading{"geometry_msgs/PoseWithCovarianceStamped", read_pose_stamped},
    Reading{"geometry_msgs/TransformStamped", read_transform},
    Reading{"tf2_msgs/TFMessage", read_transforms},
    Reading{"rosgraph_msgs/Clock", read_clock},
};

constexpr auto type_names = [] {
    std::array<std::string_view, readings.size()> names;
    std::ranges::transform(readings, names.begin(), &Reading::type);
    return names;
}();

}  // namespace

std::span<const std::string_view> readable_ros_types() {
    return type_names;
}

std::string ros_type_of(std::string_view dds_type) {
    constexpr std::string_view middle = "::msg::dds_::";
    const auto at = dds_type.find(middle);
    if (at == dds_type.npos || !dds_type.ends_with('_')) return std::string(dds_type);
    const std::string_view name = dds_type.substr(at + middle.size());
    return std::string(dds_type.substr(0, at)) + '/' + std::string(name.substr(0, name.size() - 1));
}

sim::Expected<Heard> read_ros_message(std::string_view type, std::string_view bytes) {
    const auto reading = std::ranges::find(readings, type, &Reading::type);
    if (reading == readings.end())
        return sim::refuse(std::string(type) + " holds no pose that scipd can read");
    CdrReader reader(bytes);
    Heard heard{.type = std::string(type), .poses = {}};
    const auto read = reading->read(reader, heard);
    if (!read) return sim::refuse(heard.type + ": " + read.error().why);
    return heard;
}

}  // namespace scipd::daemon
