// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/live_recording.h"

#include <utility>

namespace scipd::tools {

void LiveRecording::hear(bool to_scanner, std::string_view bytes, sim::HostTime time) {
    sim::RecordedBytes heard{to_scanner ? sim::Way::to_scanner : sim::Way::from_scanner, time,
                             std::string(bytes)};
    auto scans = decoder_.take(heard);
    heard_.push_back({std::move(heard), std::move(scans)});
}

void LiveRecording::forget_scans() {
    for (Heard& heard : heard_)
        heard.scans.clear();
}

void LiveRecording::write_to(std::unique_ptr<sim::RecordingWriter> writer) {
    writer_ = std::move(writer);
    write();
}

void LiveRecording::write() {
    for (const Heard& heard : std::exchange(heard_, {})) {
        writer_->write(heard.bytes);
        for (const sim::RecordedScan& scan : heard.scans) {
            if (has_all()) break;
            writer_->write(scan);
            ++scans_;
        }
    }
}

void LiveRecording::finish() {
    write();
    writer_->finish();
}

}  // namespace scipd::tools
