// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One way of a TCP connection, put together again: segments that come twice count once, those that
// come too early wait, and what the capture has lost is skipped once too much waits for it. A
// value; no thread rule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

class TcpStream {
  public:
    struct Piece {
        HostTime time;  ///< when its segment was captured
        std::string bytes;
    };

    /// The connection opens: its bytes begin behind this number.
    void open(std::uint32_t sequence) { next_ = sequence + 1; }

    /// The bytes that are in order now. Without open() the first segment is the beginning.
    [[nodiscard]] std::vector<Piece> add(std::uint32_t sequence, HostTime time,
                                         std::string_view payload);

    /// What waits, although something before it is lost.
    [[nodiscard]] std::vector<Piece> finish();

    /// How many bytes were skipped.
    [[nodiscard]] std::uint64_t lost() const { return lost_; }

  private:
    /// A receiver's window is mostly smaller.
    static constexpr std::size_t most_waiting = std::size_t{256} << 10;

    void take_ready(std::vector<Piece>& pieces);
    void skip_gap();

    std::optional<std::uint32_t> next_;       ///< number of the byte that comes next
    std::uint64_t position_ = 0;              ///< how many bytes came before it
    std::map<std::uint64_t, Piece> waiting_;  ///< by position
    std::size_t waiting_bytes_ = 0;
    std::uint64_t lost_ = 0;
};

}  // namespace scipd::sim
