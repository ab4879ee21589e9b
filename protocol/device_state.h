// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What all sessions of one device share: laser, clock, mode, and which sessions stream. Changed by
// sessions only, on the one thread that all of them live on.
//
//              BM                     M*
//   standby ────────► measuring ────────────► streaming      QT, the last counted scan: the stream
//   ends, and with
//      ▲ ◄──── QT ────    │  ▲ ◄── QT while others stream ─   the last stream the laser goes off
//      │                  │
//      └──── TM2 ── time adjust ◄── TM0: ends all streams, laser off           RS, RT: to standby
//      from anywhere
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/uptime.h"

namespace scipd::protocol {

class DeviceState {
  public:
    /// Names a stream; never used twice.
    using StreamId = std::uint64_t;

    [[nodiscard]] bool laser_on() const { return laser_on_; }
    /// Scans that began earlier do not exist. Meaningless while the laser is off.
    [[nodiscard]] Uptime laser_on_since() const { return laser_on_since_; }
    [[nodiscard]] bool adjusting() const { return adjusting_; }
    /// When the wire's clock was last set to 0.
    [[nodiscard]] Uptime clock_zero() const { return clock_zero_; }
    [[nodiscard]] bool streams(StreamId stream) const;
    [[nodiscard]] bool streaming() const { return !open_streams_.empty(); }

    void switch_laser_on(Uptime now);
    StreamId open_stream(Uptime now);
    /// The laser goes off with the last stream, also where BM had switched it on before. No effect
    /// on a stream that has ended already.
    void close_stream(StreamId stream);
    /// QT of a session that does not stream: the laser goes off unless others stream.
    void stop();
    void enter_adjust();
    void leave_adjust();
    /// RS and RT: laser off, no streams, no adjust mode, clock 0.
    void reset(Uptime now);

  private:
    bool laser_on_ = false;
    Uptime laser_on_since_{};
    bool adjusting_ = false;
    Uptime clock_zero_{};
    StreamId last_stream_ = 0;
    std::vector<StreamId> open_streams_;
};

}  // namespace scipd::protocol
