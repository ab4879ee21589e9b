// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/load.h"

#include <algorithm>
#include <csignal>
#include <iomanip>
#include <memory>
#include <ostream>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <nlohmann/json.hpp>

#include "tools/scipbench/spread.h"
#include "tools/scipbench/stream_reader.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

StreamReport report_of(const StreamReader& reader) {
    return {reader.target(), reader.model(), reader.check().findings(), reader.check().delays_ms(),
            reader.ended()};
}

struct Total {
    StreamFindings findings;
    std::vector<double> delays_ms;  ///< sorted

    explicit Total(const LoadReport& report) {
        for (const StreamReport& stream : report.streams) {
            findings += stream.findings;
            delays_ms.insert(delays_ms.end(), stream.delays_ms.begin(), stream.delays_ms.end());
        }
        std::ranges::sort(delays_ms);
    }

    [[nodiscard]] double delay_ms(double share) const { return at_share(delays_ms, share); }
};

void print_unsound(const StreamReport& stream, std::ostream& out) {
    const StreamFindings& found = stream.findings;
    out << stream.target << " (" << stream.model << "): " << found.scans << " scans, "
        << found.missing << " missing, " << found.damaged << " damaged, " << found.disordered
        << " out of order";
    if (!stream.ended.empty()) out << "; ended: " << stream.ended;
    out << "\n";
}

}  // namespace

std::size_t LoadReport::unsound() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(streams, [](const StreamReport& stream) { return !stream.sound(); }));
}

LoadReport load_scanners(const std::vector<std::string>& targets, std::chrono::seconds duration) {
    asio::io_context io;
    std::vector<std::unique_ptr<StreamReader>> readers;
    for (const std::string& target : targets)
        readers.push_back(std::make_unique<StreamReader>(io, target));
    asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&](const error_code&, int) { io.stop(); });
    asio::steady_timer end(io, duration);
    end.async_wait([&](const error_code&) { io.stop(); });
    const Clock::time_point begin = Clock::now();
    for (const auto& reader : readers)
        reader->start();
    read_streams(io, rest_for(targets.size()));
    LoadReport report{.seconds = std::chrono::duration<double>(Clock::now() - begin).count()};
    for (const auto& reader : readers)
        report.streams.push_back(report_of(*reader));
    return report;
}

void print_load(const LoadReport& report, std::ostream& out) {
    const Total total(report);
    const char* const many = report.streams.size() == 1 ? " scanner for " : " scanners for ";
    out << report.streams.size() << many << significant(report.seconds, 3)
        << " s: " << total.findings.scans << " scans ("
        << significant(static_cast<double>(total.findings.scans) / report.seconds, 4)
        << " a second), " << total.findings.missing << " missing, " << total.findings.damaged
        << " damaged, " << total.findings.disordered << " out of order, "
        << significant(static_cast<double>(total.findings.bytes) / 1e6 / report.seconds, 3)
        << " MB/s\n"
        << "later than the soonest of its stream: half of the scans by "
        << significant(total.delay_ms(0.5), 3) << " ms or less, 99 % by "
        << significant(total.delay_ms(0.99), 3) << ", all by " << significant(total.delay_ms(1), 3)
        << "\n";
    for (const StreamReport& stream : report.streams) {
        if (!stream.sound()) print_unsound(stream, out);
    }
}

void write_load_json(const LoadReport& report, std::ostream& out) {
    nlohmann::ordered_json streams = nlohmann::json::array();
    for (const StreamReport& stream : report.streams) {
        const StreamFindings& found = stream.findings;
        streams.push_back({{"target", stream.target},
                           {"model", stream.model},
                           {"bytes", found.bytes},
                           {"scans", found.scans},
                           {"missing", found.missing},
                           {"damaged", found.damaged},
                           {"disordered", found.disordered},
                           {"ended", stream.ended.empty() ? nlohmann::json(nullptr)
                                                          : nlohmann::json(stream.ended)}});
    }
    const Total total(report);
    const nlohmann::ordered_json document{
        {"seconds", report.seconds},
        {"scans", total.findings.scans},
        {"missing", total.findings.missing},
        {"damaged", total.findings.damaged},
        {"disordered", total.findings.disordered},
        {"delay_ms",
         {{"p50", total.delay_ms(0.5)}, {"p99", total.delay_ms(0.99)}, {"max", total.delay_ms(1)}}},
        {"streams", streams}};
    out << document.dump(2) << "\n";
}

}  // namespace scipd::tools
