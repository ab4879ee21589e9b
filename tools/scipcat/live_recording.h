// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording of a scanner that talks right now: it hears the conversation, finds the scans in it,
// and writes both. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "daemon/recording/wire_decoder.h"
#include "sim/recording/values/recording.h"

namespace scipd::tools {

class LiveRecording {
  public:
    /// Writes no more scans than `most`; 0: all.
    explicit LiveRecording(std::uint64_t most) : most_(most) {}

    /// What has gone to the scanner or come from it, and when. Keeps it in mind.
    void hear(bool to_scanner, std::string_view bytes,
              sim::HostTime time = std::chrono::system_clock::now());

    /// Whom it has heard, once the scanner has answered.
    [[nodiscard]] const sim::ScannerIdentity& identity() const { return decoder_.identity(); }

    /// Leaves out the scans so far, which some earlier client has asked for; their bytes stay.
    void forget_scans();
    /// What was heard is written from now on, from the first word on. Throws std::runtime_error, as
    /// do the next two.
    void write_to(std::unique_ptr<sim::RecordingWriter> writer);
    /// Writes what was heard since the last time.
    void write();
    void finish();

    [[nodiscard]] std::uint64_t scans() const { return scans_; }
    [[nodiscard]] bool has_all() const { return most_ > 0 && scans_ >= most_; }

  private:
    struct Heard {
        sim::RecordedBytes bytes;
        std::vector<sim::RecordedScan> scans;  ///< that these bytes have completed
    };

    daemon::WireDecoder decoder_;
    std::vector<Heard> heard_;
    std::unique_ptr<sim::RecordingWriter> writer_;
    std::uint64_t most_;
    std::uint64_t scans_ = 0;
};

}  // namespace scipd::tools
