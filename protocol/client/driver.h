// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A small driver for any SCIP scanner: it sends a request, waits for the reply and checks it. It
// reports every fault as an Error. It opens nothing and reads no clock: the transport does the
// waiting, and must outlive it. One thread.
//
//   connect() ─► version(), parameters(), state() ─► start() ─► next_scan() ... ─► stop()
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/client/decoder.h"
#include "protocol/client/device_info.h"
#include "protocol/client/error.h"
#include "protocol/client/scan_message.h"
#include "protocol/client/scan_request.h"
#include "protocol/client/transport.h"
#include "protocol/status.h"

namespace scipd::protocol::client {

struct Patience {
    std::chrono::milliseconds reply{1000};  ///< the slowest model answers once in 100 ms
    std::chrono::milliseconds scan{2000};
};

class Driver {
  public:
    explicit Driver(Transport& transport, Patience patience = {});
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    /// Finds a scanner at the other end, in any state that an earlier client left it in. Brings it
    /// to SCIP 2.0, without a stream, out of adjust mode, laser off.
    void connect();

    [[nodiscard]] Version version();
    [[nodiscard]] Parameters parameters();
    [[nodiscard]] SensorState state();

    void switch_laser_on();
    /// Sends RS: the scanner is then as after power-up, with its clock at 0.
    void reset();

    /// The latest complete scan; the laser must be on.
    [[nodiscard]] ScanMessage single_scan(const ScanRequest& request);

    void start(const ScanRequest& request);
    /// The next scan of the stream. Skips damaged ones and counts them.
    [[nodiscard]] ScanMessage next_scan();
    [[nodiscard]] std::size_t damaged_scans() const { return damaged_scans_; }
    /// Ends a running stream and switches the laser off.
    void stop();

    void enter_adjust();
    /// The scanner's clock; older models tell it in adjust mode only.
    [[nodiscard]] std::uint32_t time_ms();
    /// The scanner's clock in microseconds, without wrapping; newest firmware only.
    [[nodiscard]] std::uint64_t time_us();
    void leave_adjust();

  private:
    [[nodiscard]] Message hello();
    [[nodiscard]] std::uint64_t time(std::string_view request, std::size_t width);
    [[nodiscard]] Message ask(std::string_view request, Status also_fine = status::ok);
    [[nodiscard]] std::optional<Message> exchange(std::string_view request);
    [[nodiscard]] std::optional<Message> receive(std::chrono::milliseconds timeout);
    [[nodiscard]] bool exhausted() const;
    void begin_listening();
    /// Throws `silent` where nothing at all has come.
    [[noreturn]] void give_up(std::string_view waiting_for, const Error& silent) const;

    Transport& transport_;
    Patience patience_;
    Decoder decoder_;
    std::array<char, 8192> buffer_{};
    std::string_view unread_;   ///< the rest of buffer_
    std::size_t listened_ = 0;  ///< bytes since begin_listening()
    std::string heard_;         ///< the first of these bytes
    std::string stream_;        ///< the running request, without its number of scans
    std::size_t damaged_scans_ = 0;
};

}  // namespace scipd::protocol::client
