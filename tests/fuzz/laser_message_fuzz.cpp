// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a message of a laser in each encoding of ROS: a sound scan, or a sentence.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sim/recording/ros/laser_recording.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const Expected<LaserMessage>& message, std::size_t size) {
    if (!message) return require(!message.error().why.empty());
    const RecordedScan& scan = message->scan;
    require(scan.ranges.size() * sizeof(float) <= size);
    require(scan.intensities.empty() || scan.intensities.size() == scan.ranges.size());
    require(!scan.has_echoes() || scan.echo_ends.back() == scan.ranges.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const auto encoding : {RosEncoding::ros1, RosEncoding::cdr}) {
        for (const auto type : {LaserType::laser_scan, LaserType::multi_echo_laser_scan})
            check(parse_laser(bytes, type, encoding), size);
    }
    return 0;
}
