// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording while it is written. What it holds is on the disk after each scan, or with .mcap
// after each second of them, so that a process that is killed leaves a file that opens.
// create_recording.h makes one. Of one owner; any thread.
#pragma once

#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

class RecordingWriter {
  public:
    RecordingWriter() = default;
    virtual ~RecordingWriter() = default;
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    // All of them throw std::runtime_error where the disk is full. Scans are in millimetres.
    virtual void write(const RecordedScan& scan) = 0;
    /// Most formats have no place for the conversation, and leave it out.
    virtual void write(const RecordedBytes&) {}
    /// Ends the file; nothing may follow.
    virtual void finish() {}
};

}  // namespace scipd::sim
