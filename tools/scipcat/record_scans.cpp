// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/record_scans.h"

#include <chrono>
#include <exception>

#include "tools/scan_progress.h"
#include "tools/scipcat/live_recording.h"
#include "tools/scipcat/running_stream.h"

namespace scipd::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Until there are enough scans, the user has enough, or the scanner is gone: then its Error is
/// returned.
std::exception_ptr copy_scans(ConnectedScanner& scanner, const RecordLimits& limits,
                              const std::string& before, LiveRecording& recording,
                              bool& interrupted) {
    ScanProgress progress(before);
    std::optional<Clock::time_point> end;
    try {
        while (!recording.has_all() && (!end || Clock::now() < *end)) {
            (void)scanner.driver().next_scan();
            recording.write();
            progress.tell(recording.scans());
            if (limits.seconds && !end)
                end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                         std::chrono::duration<double>(*limits.seconds));
        }
    } catch (const Interrupted&) {
        interrupted = true;
    } catch (const protocol::client::Error&) {
        return std::current_exception();
    }
    return nullptr;
}

}  // namespace

Recorded record_scans(const ConnectionOptions& connection, const ScanOptions& scan,
                      const RecordLimits& limits, const std::string& file,
                      sim::mcap::Compression compression, const std::string& before) {
    LiveRecording recording(limits.scans);
    ConnectedScanner scanner = connection.open(
        [&](bool to_scanner, std::string_view bytes) { recording.hear(to_scanner, bytes); });
    (void)scanner.driver().state();  // it belongs to what the recording says of the scanner
    const auto request = scan.request(scanner.parameters());
    recording.forget_scans();
    Recorded recorded;
    std::exception_ptr trouble;
    {
        const RunningStream stream(scanner.driver(), request);
        scanner.transport().interrupt_on_signals();
        recording.write_to(sim::create_recording(
            file, recording.identity(),
            {.name = "scipcat", .version = SCIPD_VERSION, .compression = compression}));
        trouble = copy_scans(scanner, limits, before, recording, recorded.interrupted);
    }
    recording.finish();
    if (trouble) std::rethrow_exception(trouble);
    recorded.scans = recording.scans();
    recorded.damaged = scanner.driver().damaged_scans();
    return recorded;
}

}  // namespace scipd::tools
