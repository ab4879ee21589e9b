// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of Gazebo as bytes, written by the wire format of Protocol Buffers. Any thread.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace scipd::tests {

inline std::string gz_varint(std::uint64_t value) {
    std::string bytes;
    for (; value >= 128; value >>= 7U)
        bytes += static_cast<char>(value | 128U);
    bytes += static_cast<char>(value);
    return bytes;
}

inline std::string gz_integer(unsigned field, std::uint64_t value) {
    return gz_varint(field << 3U) + gz_varint(value);
}

inline std::string gz_within(unsigned field, const std::string& bytes) {
    return gz_varint(field << 3U | 2U) + gz_varint(bytes.size()) + bytes;
}

/// Zeros are left out, as its makers do.
inline std::string gz_numbers(unsigned field, const std::vector<double>& numbers) {
    std::string bytes;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] == 0.0) continue;
        std::array<char, 8> raw{};
        std::memcpy(raw.data(), &numbers[i], raw.size());
        bytes += gz_varint((i + 2) << 3U | 1U);
        bytes.append(raw.data(), raw.size());
    }
    return gz_within(field, bytes);
}

inline std::string gz_header(std::chrono::milliseconds time) {
    using namespace std::chrono_literals;
    const auto stamp = gz_integer(1, static_cast<std::uint64_t>(time / 1s)) +
                       gz_integer(2, static_cast<std::uint64_t>(time % 1s / 1ns));
    return gz_within(1, gz_within(1, stamp));
}

struct GzPose {
    std::string name;
    std::uint64_t id = 0;
    double x = 0.0;
    double y = 0.0;
};

inline std::string gz_pose(const GzPose& pose) {
    return gz_within(2, pose.name) + gz_integer(3, pose.id) + gz_numbers(4, {pose.x, pose.y, 0.0}) +
           gz_numbers(5, {0.0, 0.0, 0.0, 1.0});
}

/// Pose_V
inline std::string gz_poses(std::optional<std::chrono::milliseconds> time,
                            const std::vector<GzPose>& poses) {
    std::string bytes;
    if (time) bytes = gz_header(*time);
    for (const GzPose& pose : poses)
        bytes += gz_within(2, gz_pose(pose));
    return bytes;
}

}  // namespace scipd::tests
