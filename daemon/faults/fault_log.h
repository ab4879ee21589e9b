// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was injected: the latest entries, and what people see of a fault. Values; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/time.h"

namespace scipd::daemon {

struct FaultLogEntry {
    std::uint64_t number = 0;  ///< counts the entries of a sensor, from 1
    std::uint64_t id = 0;      ///< of the fault
    std::string kind;
    std::string what;  ///< for people: "begins", "3 bytes of MD changed", "ends"
    std::int64_t scan = 0;
    std::string request;  ///< its echo; empty: no request
    sim::Time told{};     ///< as people call the time
    std::vector<std::size_t> bytes;
    std::vector<int> steps;
};

struct FaultStatus {
    std::uint64_t id = 0;
    std::string kind;
    std::string state;  ///< "waiting", "active" or "ended"
    std::uint64_t hits = 0;
    std::string said;                  ///< what was asked for, a JSON object
    std::optional<int> scenario_step;  ///< the step of a scenario, from 1
};

class FaultLog {
  public:
    using Entries = std::deque<FaultLogEntry>;
    using Watcher = std::function<void(const FaultLogEntry&)>;
    static constexpr std::size_t capacity = 4096;
    /// How many bytes and steps all entries name together; beyond that, the oldest entries go.
    static constexpr std::size_t most_places = 1'000'000;

    void add(FaultLogEntry entry);
    /// A fault has acted.
    void count_hit() { ++hits_; }
    /// How often faults have acted, also those that are forgotten.
    [[nodiscard]] std::uint64_t hits() const { return hits_; }
    [[nodiscard]] const Entries& entries() const { return entries_; }
    /// The number of the latest entry; 0: none yet.
    [[nodiscard]] std::uint64_t last() const { return last_; }
    /// Is told of each entry from here on; null: nobody.
    void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  private:
    Entries entries_;         ///< the latest
    std::size_t places_ = 0;  ///< bytes and steps of all entries
    std::uint64_t last_ = 0;
    std::uint64_t hits_ = 0;
    Watcher watcher_;
};

}  // namespace scipd::daemon
