// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/stream_reader.h"

#include <chrono>
#include <thread>
#include <utility>

#include <boost/asio/write.hpp>

#include "protocol/client/driver.h"
#include "tools/scip_transport.h"
#include "tools/target.h"

namespace scipd::tools {

namespace asio = boost::asio;
using boost::system::error_code;

StreamReader::StreamReader(asio::io_context& io, std::string target)
    : stream_(io), target_(std::move(target)) {
    const auto transport = open_target(parse_target(target_));
    protocol::client::Driver driver(*transport);
    driver.connect();
    const protocol::client::Parameters parameters = driver.parameters();
    driver.switch_laser_on();
    model_ = parameters.model;
    request_ = {.first_step = parameters.amin, .last_step = parameters.amax};
    constexpr double ms_per_minute = 60'000.0;
    period_ = StreamCheck::Milliseconds(ms_per_minute / parameters.scan_rpm);
    check_.emplace(request_, period_);
    stream_.assign(transport->release());
}

void StreamReader::start(std::function<void()> on_read) {
    on_read_ = std::move(on_read);
    error_code error;
    asio::write(stream_, asio::buffer(protocol::client::stream_line(request_) + "\n"), error);
    read();
}

void StreamReader::read() {
    stream_.async_read_some(
        asio::buffer(buffer_), [this](const error_code& error, std::size_t count) {
            if (error) ended_ = error.message();
            if (!error) check_->take({buffer_.data(), count}, std::chrono::steady_clock::now());
            on_read_();
            if (!error) read();
        });
}

// Whoever wakes up for each of thousands of scans a second takes a core away from what sends them
// each time: with 350 scanners on two cores a scan then costs an eighth more in all. Scans of few
// scanners are read at once, so that their delays are exact.
std::chrono::milliseconds rest_for(std::size_t readers) {
    constexpr std::size_t few = 32;
    return std::chrono::milliseconds(readers > few ? 1 : 0);
}

void read_streams(asio::io_context& io, std::chrono::milliseconds rest) {
    while (io.run_one() > 0) {
        io.poll();
        std::this_thread::sleep_for(rest);
    }
}

}  // namespace scipd::tools
