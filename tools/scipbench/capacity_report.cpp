// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_report.h"

#include <cmath>
#include <iomanip>
#include <ostream>
#include <thread>

#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

double processors() {
    return std::thread::hardware_concurrency();
}

double used(const ProcessorUse& use) {
    return use.user_s + use.kernel_s;
}

/// Seconds of each second become microseconds of each scan.
double per_scan_us(double share, const CapacityRun& run) {
    return run.scans_per_s() > 0.0 ? 1e6 * share / run.scans_per_s() : 0.0;
}

void print_cost(std::ostream& out, const char* name, double us, const char* what) {
    std::string text = significant(std::abs(us), 3);
    if (us < 0.0) text.insert(0, 1, '-');
    out << "  " << std::left << std::setw(8) << name << std::right << std::setw(8) << text
        << " us  " << what << "\n";
}

}  // namespace

double bare_share(const CapacityRun& run, const StageCosts& costs) {
    return run.scans_per_s() * 1e-6 * costs.bare_cast_us / processors();
}

double share_of_all(const ProcessorUse& use_a_second) {
    return used(use_a_second) / processors();
}

void print_run_header(std::ostream& out) {
    out << "scanners  scans/s  missing     lost  bare casts   scipd  reader  late p50       p99"
           "  timer p99\n"
           "                             (scipd)      of all   cores   cores        ms        ms"
           "         ms\n";
}

void print_run(const CapacityRun& run, const StageCosts& costs, std::ostream& out) {
    out << std::setw(8) << run.scanners;
    if (!run.failure.empty()) {
        out << "  " << run.failure << "\n" << std::flush;
        return;
    }
    const auto cell = [&](int width, double value) {
        out << std::setw(width) << significant(value, 3);
    };
    out << std::setw(9) << significant(run.scans_per_s(), 4) << std::setw(9) << run.missing
        << std::setw(9) << run.lost;
    cell(12, bare_share(run, costs));
    cell(8, used(run.scipd_use));
    cell(8, used(run.reader_use));
    cell(10, run.scipd.p50_ms);
    cell(10, run.scipd.p99_ms);
    cell(11, run.timer.p99_ms);
    out << (run.loses()          ? "  loses scans"
            : run.falls_behind() ? "  falls behind"
                                 : "")
        << "\n"
        << std::flush;
}

void print_costs(const CapacityRun& run, const StageCosts& costs, std::ostream& out) {
    if (!run.failure.empty()) return;
    const double alone_us = costs.poses_us + costs.cast_us + costs.errors_us + costs.encode_us;
    const double user_us = per_scan_us(run.scipd_use.user_s, run);
    out << "bare casts, as a share of all cores: " << significant(bare_share(run, costs), 2) << " ("
        << costs.rays << " rays from one pose: " << significant(costs.bare_cast_us, 3)
        << " us)\nscipd used " << significant(used(run.scipd_use), 3) << " cores, the reader "
        << significant(used(run.reader_use), 3) << " of " << std::thread::hardware_concurrency()
        << "\na scan of " << run.scanners << " scanners costs scipd "
        << significant(per_scan_us(used(run.scipd_use), run), 3) << " us:\n";
    print_cost(out, "poses", costs.poses_us, "measured alone");
    print_cost(out, "cast", costs.cast_us, "measured alone");
    print_cost(out, "errors", costs.errors_us, "measured alone");
    print_cost(out, "encode", costs.encode_us, "measured alone");
    print_cost(out, "send", per_scan_us(run.scipd_use.kernel_s, run),
               "all that the kernel does for scipd: sockets, timers");
    print_cost(out, "else", user_us - alone_us,
               "the rest of scipd's own time; caches are shared there");
    out << "and beside that:\n";
    print_cost(out, "cast", run.casts_us, "as scipd counts it, with what interrupted it");
    print_cost(out, "wait", per_scan_us(run.scipd_use.waited_s(), run),
               "scipd's threads could run, but others had all cores");
    print_cost(out, "read", per_scan_us(used(run.reader_use), run), "the reader's share");
}

void print_lateness(const CapacityRun& run, std::ostream& out) {
    if (!run.failure.empty()) return;
    const auto pair = [](const Late& late) {
        return "p50 " + significant(late.p50_ms, 3) + " ms, p99 " + significant(late.p99_ms, 3) +
               " ms";
    };
    out << "lateness of " << run.scanners << " scanners: " << pair(run.scipd)
        << " (p99 of the worst " << significant(run.worst_p99_ms, 3) << " ms)\n"
        << "  of a bare timer beside:  " << pair(run.timer) << "\n"
        << "  as the reader sees it:   " << pair(run.reader) << "\n"
        << "  lost: " << run.lost << ", missing: " << run.missing << "\n";
}

// What is busy for so much of the time cannot make up for a moment that it has lost.
std::string what_limits(const CapacityRun& run) {
    constexpr double busy = 0.9;
    if (!run.failure.empty()) return run.failure;
    const ThreadUse busiest = busiest_of(run.scipd_use);
    const double both = used(run.scipd_use) + used(run.reader_use);
    if (both >= busy * processors())
        return "the cores: scipd and the reader used " + significant(both, 3) + " of " +
               significant(processors(), 1);
    if (busiest.ran_s >= busy)
        return "the thread \"" + busiest.name + "\" of scipd, which had a core to itself for " +
               significant(100.0 * busiest.ran_s, 3) + " % of the time";
    const double waited = run.scipd_use.waited_s();
    const std::string there = significant(both, 3) + " of " + significant(processors(), 1) +
                              " cores were used, and scipd's threads waited " +
                              significant(waited, 2) + " s of each second for one";
    return (waited > 1.0 - busy ? "others on this machine, it seems: " : "no core was full: ") +
           there;
}

void write_runs_csv(const std::vector<CapacityRun>& runs, const StageCosts& costs,
                    std::ostream& out) {
    out << "scanners,holds,seconds,start_s,scans,missing,lost,scans_per_s,bare_cast_us,"
           "bare_cast_share,poses_us,stage_cast_us,errors_us,encode_us,casts_us,scipd_user_cores,"
           "scipd_kernel_cores,scipd_waiting,reader_cores,late_p50_ms,late_p99_ms,"
           "late_worst_p99_ms,reader_p50_ms,reader_p99_ms,timer_p50_ms,timer_p99_ms\n";
    for (const CapacityRun& run : runs) {
        out << run.scanners << "," << run.holds() << "," << run.seconds << "," << run.start_s << ","
            << run.scans << "," << run.missing << "," << run.lost << "," << run.scans_per_s();
        for (const double value :
             {costs.bare_cast_us, bare_share(run, costs), costs.poses_us, costs.cast_us,
              costs.errors_us, costs.encode_us, run.casts_us, run.scipd_use.user_s,
              run.scipd_use.kernel_s, run.scipd_use.waited_s(), used(run.reader_use),
              run.scipd.p50_ms, run.scipd.p99_ms, run.worst_p99_ms, run.reader.p50_ms,
              run.reader.p99_ms, run.timer.p50_ms, run.timer.p99_ms})
            out << "," << value;
        out << "\n";
    }
}

}  // namespace scipd::tools
