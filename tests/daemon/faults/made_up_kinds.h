// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Kinds of faults that do nothing, for tests of how faults are read and scheduled.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/read_fault.h"

namespace scipd::tests {

/// An effect without members.
struct Nothing : daemon::FaultEffect {
    struct Members {};
    static constexpr std::array<daemon::Member<Members>, 0> members{};
    explicit Nothing(const Members& /*unused*/) {}
    static void check(const Members& /*unused*/, const sim::YamlField& /*unused*/,
                      sim::YamlFaults& /*unused*/) {}
};

/// One with members of each sort.
struct Scratch : daemon::FaultEffect {
    struct Members {
        double rate = -1.0;
        std::string status;
        bool boot = false;
        std::vector<double> steps;
    };
    static sim::Expected<std::string> parse_word(std::string_view text) {
        if (text.empty()) return sim::refuse("must not be empty");
        return std::string(text);
    }
    static constexpr std::array<daemon::Member<Members>, 4> members{{
        {"rate", daemon::read_as<&Members::rate, daemon::parse_share>},
        {"status", daemon::read_as<&Members::status, parse_word>},
        {"boot", daemon::read_as<&Members::boot, daemon::parse_switch>},
        {"steps", daemon::read_list<&Members::steps, daemon::parse_length>},
    }};
    explicit Scratch(Members said) : said(std::move(said)) {}
    static void check(const Members& said, const sim::YamlField& fault, sim::YamlFaults& faults) {
        if (said.rate < 0.0) faults.add(fault, "needs rate, 0 to 1");
    }

    const Members said;
};

/// In the order in which a refusal lists them.
inline const daemon::FaultKinds& made_up_kinds() {
    static constexpr daemon::FaultKind nothing =
        daemon::kind_of<Nothing>("nothing", "device", "does nothing", true);
    static constexpr daemon::FaultKind scratch =
        daemon::kind_of<Scratch>("scratch", "scans", "does nothing, with members");
    static const daemon::FaultKinds kinds{&nothing, &scratch};
    return kinds;
}

}  // namespace scipd::tests
