// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/load.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <iomanip>
#include <memory>
#include <ostream>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <nlohmann/json.hpp>

#include "protocol/client/driver.h"
#include "protocol/client/error.h"
#include "tools/scip_transport.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using protocol::client::ScanRequest;
using Clock = std::chrono::steady_clock;

class Reader {
  public:
    /// Connects and asks what scanner it is.
    Reader(asio::io_context& io, std::string target) : stream_(io), target_(std::move(target)) {
        const auto transport = open_target(parse_target(target_));
        protocol::client::Driver driver(*transport);
        driver.connect();
        const protocol::client::Parameters parameters = driver.parameters();
        driver.switch_laser_on();
        model_ = parameters.model;
        request_ = {.first_step = parameters.amin, .last_step = parameters.amax};
        constexpr double ms_per_minute = 60'000.0;
        check_.emplace(request_, StreamCheck::Milliseconds(ms_per_minute / parameters.scan_rpm));
        stream_.assign(transport->release());
    }

    void start() {
        error_code error;
        asio::write(stream_, asio::buffer(stream_line(request_) + "\n"), error);
        read();
    }

    [[nodiscard]] StreamReport report() const {
        return {target_, model_, check_->findings(), check_->delays_ms(), ended_};
    }

  private:
    void read() {
        stream_.async_read_some(asio::buffer(buffer_),
                                [this](const error_code& error, std::size_t count) {
                                    if (error) return void(ended_ = error.message());
                                    check_->take({buffer_.data(), count}, Clock::now());
                                    read();
                                });
    }

    asio::posix::stream_descriptor stream_;
    std::string target_;
    std::string model_;
    ScanRequest request_;
    std::optional<StreamCheck> check_;
    std::string ended_;
    std::array<char, 16 * 1024> buffer_;
};

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

/// Whoever wakes up for each of thousands of scans a second takes a core away from what sends them
/// each time: with 350 scanners on two cores a scan then costs an eighth more in all. Scans of few
/// scanners are read at once, so that their delays are exact.
std::chrono::milliseconds between_rounds(std::size_t scanners) {
    constexpr std::size_t few = 32;
    return std::chrono::milliseconds(scanners > few ? 1 : 0);
}

void read_in_rounds(asio::io_context& io, std::chrono::milliseconds rest) {
    while (io.run_one() > 0) {
        io.poll();
        std::this_thread::sleep_for(rest);
    }
}

}  // namespace

std::size_t LoadReport::unsound() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(streams, [](const StreamReport& stream) { return !stream.sound(); }));
}

LoadReport load_scanners(const std::vector<std::string>& targets, std::chrono::seconds duration) {
    asio::io_context io;
    std::vector<std::unique_ptr<Reader>> readers;
    for (const std::string& target : targets)
        readers.push_back(std::make_unique<Reader>(io, target));
    asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&](const error_code&, int) { io.stop(); });
    asio::steady_timer end(io, duration);
    end.async_wait([&](const error_code&) { io.stop(); });
    const Clock::time_point begin = Clock::now();
    for (const auto& reader : readers)
        reader->start();
    read_in_rounds(io, between_rounds(targets.size()));
    LoadReport report{.seconds = std::chrono::duration<double>(Clock::now() - begin).count()};
    for (const auto& reader : readers)
        report.streams.push_back(reader->report());
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
