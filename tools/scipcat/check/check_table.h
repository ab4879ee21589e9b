// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The numbered list of what a scanner is held to. Data; no thread rule.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "tools/scipcat/check/facts.h"
#include "tools/scipcat/check/finding.h"
#include "tools/scipcat/check/subject.h"

namespace scipd::tools::checks {

/// What a line of products answers in place of what the specification says.
struct KnownDifference {
    Line line = Line::other;
    std::string_view status;
    std::string_view source;  ///< who saw it
};

struct Check {
    std::string_view id;      ///< "4.2", which never changes its meaning
    std::string_view title;   ///< what must hold
    std::string_view source;  ///< who says so
    Finding (*look)(Subject&);
    std::array<KnownDifference, 2> known{};
};

struct Chapter {
    std::string_view title;
    std::span<const Check> checks;
    /// These write settings or reboot, and are made only if the user says so.
    bool unsafe = false;
};

/// All of them, in the order of their numbers.
[[nodiscard]] std::span<const Chapter> chapters();
/// The number before the dot.
[[nodiscard]] std::string_view chapter_of(std::string_view id);
/// Whether there is such a chapter ("4") or check ("4.2").
[[nodiscard]] bool is_section(std::string_view section);
/// Whether the check is, or is of, this section.
[[nodiscard]] bool belongs_to(std::string_view id, std::string_view section);

/// The chapters, one a file.
[[nodiscard]] std::span<const Check> scip1_checks();
[[nodiscard]] std::span<const Check> identity_checks();
[[nodiscard]] std::span<const Check> framing_checks();
[[nodiscard]] std::span<const Check> state_checks();
[[nodiscard]] std::span<const Check> single_scan_checks();
[[nodiscard]] std::span<const Check> stream_checks();
[[nodiscard]] std::span<const Check> cluster_checks();
[[nodiscard]] std::span<const Check> clock_checks();
[[nodiscard]] std::span<const Check> bad_request_checks();
[[nodiscard]] std::span<const Check> line_end_checks();
[[nodiscard]] std::span<const Check> pipelining_checks();
[[nodiscard]] std::span<const Check> two_client_checks();
[[nodiscard]] std::span<const Check> rate_checks();
[[nodiscard]] std::span<const Check> unsafe_checks();

}  // namespace scipd::tools::checks
