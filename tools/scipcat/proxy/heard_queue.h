// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one thread has heard, for another one to look at, without a lock: whoever holds one may lose
// its core, and the other waits for milliseconds. Nor does one of them free what the other has
// allocated, since the heap has locks as well: the bytes lie in a ring. One thread pushes, one
// pops.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/recording/values/recorded_scan.h"

namespace scipd::tools {

struct Heard {
    enum class What : std::uint8_t { to_scanner, from_scanner, driver_came, driver_left };
    What what = What::from_scanner;
    sim::HostTime time{};
    std::string bytes;
};

class HeardQueue {
  public:
    /// Waits where there is no room, and never for more than that.
    void push(Heard::What what, sim::HostTime time, std::string_view bytes);
    /// Nothing: it is empty.
    [[nodiscard]] std::optional<Heard> pop();

  private:
    struct Head {
        Heard::What what;
        std::uint32_t size;
        std::int64_t time_ns;
    };

    /// At the pace of a UST-10LX, a minute.
    static constexpr std::size_t capacity = std::size_t{1} << 23U;

    void put(std::size_t at, const void* from, std::size_t count);
    void get(std::size_t at, void* to, std::size_t count) const;

    std::unique_ptr<char[]> ring_ = std::make_unique_for_overwrite<char[]>(capacity);
    // Bytes since the beginning.
    std::atomic<std::size_t> pushed_{0};
    std::atomic<std::size_t> popped_{0};
};

}  // namespace scipd::tools
