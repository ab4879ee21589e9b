// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user asks to go wrong at a sensor: what, when, for how long, how often. Checked values;
// any thread. read_fault.h reads them, FaultInjector carries them out.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "sim/time.h"

namespace scipd::daemon {

class FaultEffect;
struct FaultKind;

/// As soon as it is asked for.
struct AtOnce {
    bool operator==(const AtOnce&) const = default;
};
/// With the scan of this number, as /stream and truth have it.
struct AtScan {
    std::int64_t scan = 0;
    bool operator==(const AtScan&) const = default;
};
/// At this time, as /status tells it.
struct AtTime {
    sim::Time told{};
    bool operator==(const AtTime&) const = default;
};
/// So many scans after the fault was asked for, or after its scenario began.
struct AfterScans {
    std::int64_t scans = 0;
    bool operator==(const AfterScans&) const = default;
};
struct AfterTime {
    sim::Time time{};
    bool operator==(const AfterTime&) const = default;
};
/// With the nth request of this code from then on: that one is met already.
struct AtRequest {
    std::string command;
    int nth = 1;
    bool operator==(const AtRequest&) const = default;
};
using FaultStart = std::variant<AtOnce, AtScan, AtTime, AfterScans, AfterTime, AtRequest>;

/// It lasts until somebody stops it, or is over at once where its kind is.
struct UntilStopped {
    bool operator==(const UntilStopped&) const = default;
};
struct ForScans {
    std::int64_t scans = 0;
    bool operator==(const ForScans&) const = default;
};
struct ForTime {
    sim::Time time{};
    bool operator==(const ForTime&) const = default;
};
/// Until such a request is answered, which is spared. RB: until the device boots.
struct UntilRequest {
    std::string command;
    bool operator==(const UntilRequest&) const = default;
};
using FaultEnd = std::variant<UntilStopped, ForScans, ForTime, UntilRequest>;

/// It begins again and again, at even distances from when it was asked for, each earlier or later
/// by up to the jitter.
template <class Distance>
struct Every {
    Distance distance{};
    Distance jitter{};
    bool operator==(const Every&) const = default;
};
using FaultRepetition =
    std::variant<std::monostate, Every<std::int64_t> /* scans */, Every<sim::Time>>;

struct FaultPlan {
    const FaultKind* kind = nullptr;
    FaultStart start;
    FaultEnd end;
    FaultRepetition every;  ///< where it is there, `start` is AtOnce
    std::optional<std::uint64_t> seed;
    /// A new effect with the kind's own members.
    std::function<std::unique_ptr<FaultEffect>()> make;
    std::string said;  ///< all of it as one JSON object, without its sensor
};

}  // namespace scipd::daemon
