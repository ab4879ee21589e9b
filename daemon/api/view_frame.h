// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A measurement as bytes that a page can draw, for /view. Little-endian: the bytes `SCV1`, the
// number of the frame, the length of the header, and the header in JSON; then the arrays that it
// lists. Each array begins at a multiple of 4. Any thread; nothing shared.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/device/sensor_record.h"

namespace scipd::daemon {

/// How much of a measurement is wanted.
enum class ViewDepth : std::uint8_t {
    none,
    sent,   ///< what the sensor says
    truth,  ///< and what its beams met
};

/// What a scanner says of itself; files of its scans need it.
struct ScannerIdentity {
    std::string model;
    std::string serial;
    std::string firmware;
    int dmin_mm = 0;      ///< DMIN of PP
    int nearest_mm = 0;   ///< what is less is a code
    int farthest_mm = 0;  ///< and what is more
    int rpm = 0;
};

/// Frames have the number 0 until somebody gives them another.
std::string view_frame(const std::string& sensor, const ScanRecord& record,
                       const ScannerIdentity& scanner, ViewDepth depth);
std::string view_frame(const std::string& sensor, const StaringRecord& record, ViewDepth depth);

void set_frame_number(std::string& frame, std::uint32_t number);

}  // namespace scipd::daemon
