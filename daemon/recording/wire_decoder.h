// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds scans, and who sends them, in the bytes that a scanner has sent. Of one owner; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/client/decoder.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::daemon {

class WireDecoder {
  public:
    /// The scans that these bytes complete. What goes to the scanner completes none.
    [[nodiscard]] std::vector<sim::RecordedScan> take(const sim::RecordedBytes& bytes);

    [[nodiscard]] const sim::ScannerIdentity& identity() const { return identity_; }
    /// Messages of SCIP 2.0 without a fault, and scans of SCIP 1.1; where there are none, it was
    /// another conversation.
    [[nodiscard]] std::size_t sound_messages() const { return sound_messages_; }
    /// Scans that were damaged, or cut by a gap in the bytes.
    [[nodiscard]] std::size_t damaged_scans() const { return damaged_scans_; }

  private:
    void take_message(const protocol::client::Message& message, sim::HostTime time,
                      std::vector<sim::RecordedScan>& scans);

    protocol::client::Decoder decoder_;
    sim::ScannerIdentity identity_;
    std::size_t sound_messages_ = 0;
    std::size_t damaged_scans_ = 0;
};

}  // namespace scipd::daemon
