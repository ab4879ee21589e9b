// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare_take.h"

#include <chrono>
#include <optional>

#include "daemon/recording/scip_values.h"
#include "protocol/client/error.h"
#include "tools/analysis/scan_table.h"
#include "tools/options.h"
#include "tools/scan_progress.h"
#include "tools/scipcat/read_clock.h"
#include "tools/scipcat/running_stream.h"

namespace scipd::tools {
namespace {

using comparing::Taken;

Taken take_recorded(const TakeOptions& options, const std::string& letter) {
    const std::string& file = options.connection.target;
    const auto recording = open_recorded(file);
    Taken taken{file, {}, {}, {}};
    const std::size_t stream =
        read_scans(*recording, file,
                   {.stream = options.stream,
                    .most = options.scans > 0 ? options.scans : most_compared,
                    .option = letter == "A" ? "--stream-a" : "--stream-b",
                    .progress = letter + ": "},
                   taken.series);
    if (recording->streams().size() > 1) taken.name += " " + recording->streams()[stream].name;
    return taken;
}

/// How long after their stamps scans had come, by what the clock said before them.
std::optional<double> latency_ms(const ScanTable& series, const ClockReading& clock) {
    if (!series.first_host_time) return std::nullopt;
    const double first_host_s =
        std::chrono::duration<double>(series.first_host_time->time_since_epoch()).count();
    double sum_s = 0;
    double count = 0;
    for (const ScanTime& time : series.times) {
        if (!time.stamp_s || !time.host_s) continue;
        const double since_s = *time.stamp_s + series.tick_s / 2 - clock.device_s;
        sum_s += first_host_s + *time.host_s - (clock.host_s + since_s);
        ++count;
    }
    return count > 0 ? std::optional(1e3 * sum_s / count) : std::nullopt;
}

Taken take_live(const TakeOptions& options, const ScanOptions& scan, const std::string& letter) {
    constexpr std::uint64_t enough = 100;
    const std::uint64_t most = options.scans > 0 ? options.scans : enough;
    ConnectedScanner scanner = options.connection.open();
    scanner.transport().interrupt_on_signals();
    const auto identity = daemon::identity_of(scanner.version(), scanner.parameters());
    Taken taken{options.connection.target, {.identity = identity}, {}, {}};
    const auto before = read_clock(scanner.driver());
    {
        const RunningStream stream(scanner.driver(), scan.request(scanner.parameters()));
        ScanProgress progress(letter + ": ");
        while (taken.series.scans() < most) {
            const auto message = scanner.driver().next_scan();
            taken.series.add(
                daemon::recorded_scan(message, identity, std::chrono::system_clock::now()));
            progress.tell(taken.series.scans());
        }
    }
    if (!before) return taken;
    taken.latency_ms = latency_ms(taken.series, *before);
    if (const auto after = read_clock(scanner.driver()))
        taken.clock = rate_between(*before, *after);
    return taken;
}

}  // namespace

Taken take_scans(const TakeOptions& options, const ScanOptions& scan, const std::string& letter) {
    if (is_recording(options.connection.target)) return take_recorded(options, letter);
    try {
        return take_live(options, scan, letter);
    } catch (const protocol::client::Error& error) {
        throw WrongInput(options.connection.target + ": " + error.what());
    }
}

}  // namespace scipd::tools
