// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare_take.h"

#include <chrono>
#include <optional>
#include <ranges>
#include <utility>
#include <variant>

#include "daemon/recording/scip_values.h"
#include "protocol/client/error.h"
#include "sim/text/quote.h"
#include "tools/options.h"
#include "tools/scipcat/read_clock.h"
#include "tools/scipcat/recording_target.h"
#include "tools/scipcat/running_stream.h"
#include "tools/scipcat/scan_progress.h"

namespace scipd::tools {
namespace {

using comparing::Taken;

Taken take_recorded(const TakeOptions& options, const std::string& letter) {
    const std::string& file = options.connection.target;
    const auto recording = open_recorded(file);
    const std::uint64_t most = options.scans > 0 ? options.scans : most_compared;
    ScanProgress progress(letter + ": ");
    std::optional<std::size_t> stream;
    std::optional<ScanSeries> series;
    while (!series || series->scans() < most) {
        auto item = recording->next();
        if (!item) throw WrongInput(item.error().why);
        if (!*item) break;
        const std::size_t at = (*item)->stream;
        const sim::RecordedStream& of = recording->streams()[at];
        if (!stream && (options.stream.empty() || of.name == options.stream)) {
            stream = at;
            series.emplace(of.identity);
        }
        if (stream != at) continue;
        series->learn(of.identity);
        series->add(std::get<sim::RecordedScan>((*item)->what));
        progress.tell(series->scans());
    }
    if (!series && !options.stream.empty())
        throw WrongInput(
            file + " has no stream \"" + options.stream + "\" with scans; it has " +
            sim::listed(recording->streams() | std::views::transform(&sim::RecordedStream::name)));
    if (!series) throw WrongInput(file + " holds no scans");
    const bool several = recording->streams().size() > 1;
    return {several ? file + " " + recording->streams()[*stream].name : file, *std::move(series)};
}

/// How long after their stamps scans had come, by what the clock said before them.
std::optional<double> latency_ms(const ScanSeries& series, double first_host_s,
                                 const ClockReading& clock) {
    double sum_s = 0;
    double count = 0;
    for (const ScanTime& time : series.times()) {
        if (!time.stamp_s || !time.host_s) continue;
        const double since_s = *time.stamp_s + series.tick_s() / 2 - clock.device_s;
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
    Taken taken{options.connection.target, ScanSeries(identity)};
    const auto before = read_clock(scanner.driver());
    std::optional<sim::HostTime> first;
    {
        const RunningStream stream(scanner.driver(), scan.request(scanner.parameters()));
        ScanProgress progress(letter + ": ");
        while (taken.series.scans() < most) {
            const auto message = scanner.driver().next_scan();
            const sim::HostTime now = std::chrono::system_clock::now();
            if (!first) first = now;
            taken.series.add(daemon::recorded_scan(message, identity, now));
            progress.tell(taken.series.scans());
        }
    }
    if (!before) return taken;
    taken.latency_ms = latency_ms(
        taken.series, std::chrono::duration<double>(first->time_since_epoch()).count(), *before);
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
