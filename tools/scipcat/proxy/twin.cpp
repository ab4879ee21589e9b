// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/twin.h"

#include <array>
#include <chrono>
#include <utility>

#include "protocol/client/scan_request.h"

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

constexpr auto look_again = 1s;
// A scan that is older than this says nothing about the scanner's.
constexpr auto oldest = 1s;
// The twin reads slower than the driver talks: it is left out of what it cannot take.
constexpr std::size_t most_unwritten_bytes = 64 * 1024;

sim::RecordedBytes from_scanner(sim::HostTime time, std::string_view bytes) {
    return {sim::Way::from_scanner, time, std::string(bytes)};
}

/// Whether a request ends streams.
bool ends_streams(std::string_view line) {
    constexpr std::array<std::string_view, 4> codes{"QT", "RS", "RB", "%SL"};
    return std::ranges::any_of(codes, [&](auto code) { return line.starts_with(code); });
}

bool begins_stream(std::string_view line) {
    const auto request = protocol::client::parse_scan_echo(line);
    return request && !line.starts_with('G') && !line.starts_with('H');
}

}  // namespace

Twin::Twin(const boost::asio::any_io_executor& executor, Target target, OpenOptions options,
           double tolerance_mm, Hooks hooks)
    : target_(std::move(target)),
      options_(options),
      hooks_(std::move(hooks)),
      again_(executor),
      comparison_(tolerance_mm) {}

void Twin::come() {
    leave();
    driven_ = true;
    twin_ = std::make_shared<FarEnd>(
        again_.get_executor(),
        FarEnd::Hooks{.opened = [this] { opened(); },
                      .heard = [this](std::string_view bytes) { hear_twin(bytes); },
                      .drained = [] {},
                      .lost = [this](const std::string& why) { lost(why); }});
    twin_->open(target_, options_);
}

void Twin::leave() {
    again_.cancel();
    driven_ = false;
    if (twin_) std::exchange(twin_, nullptr)->close();
    latest_.reset();
    requests_.forget();
    stream_.clear();
}

void Twin::opened() {
    news("the twin is there");
    if (!stream_.empty()) twin_->write("BM\n" + stream_ + "\n");
}

void Twin::lost(const std::string& why) {
    news("the twin is gone: " + why);
    twin_ = nullptr;
    latest_.reset();
    again_.expires_after(look_again);
    again_.async_wait([this](const boost::system::error_code& error) {
        if (error || !driven_) return;
        const std::string stream = stream_;
        come();
        stream_ = stream;
    });
}

void Twin::news(const std::string& sentence) {
    if (std::exchange(told_, sentence) != sentence) hooks_.news(sentence);
}

void Twin::hear(bool to_scanner, sim::HostTime time, std::string_view bytes) {
    if (to_scanner) return tell_request(bytes);
    for (const sim::RecordedScan& scan : scanner_says_.take(from_scanner(time, bytes)))
        compare(scan);
}

void Twin::tell_request(std::string_view bytes) {
    if (twin_ && twin_->unwritten() < most_unwritten_bytes) twin_->write(bytes);
    while (const auto line = requests_.next(bytes)) {
        if (ends_streams(line->text)) stream_.clear();
        if (begins_stream(line->text)) stream_ = line->text;
    }
}

void Twin::hear_twin(std::string_view bytes) {
    for (sim::RecordedScan& scan :
         twin_says_.take(from_scanner(std::chrono::system_clock::now(), bytes)))
        latest_ = std::move(scan);
}

void Twin::compare(const sim::RecordedScan& scan) {
    if (!latest_ || *scan.host_time - *latest_->host_time > oldest) return;
    ++compared_;
    for (const TwinChange& change : comparison_.add(scan, *latest_, scanner_says_.identity()))
        hooks_.changed(change);
}

}  // namespace scipd::tools
