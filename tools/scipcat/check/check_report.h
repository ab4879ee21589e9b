// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What came of all checks, and its forms for people and programs. A value; no thread rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/scipcat/check/check_table.h"
#include "tools/scipcat/check/facts.h"
#include "tools/scipcat/check/finding.h"
#include "tools/scipcat/check/nearest_firmware.h"

namespace scipd::tools::checks {

struct Result {
    const Chapter* chapter = nullptr;
    const Check* check = nullptr;
    Finding finding;
    // Printable.
    std::string sent;
    std::string got;
    double seconds = 0.0;
};

struct CheckReport {
    std::string target;
    Facts facts;
    std::vector<Result> results;
    std::optional<NearestFirmware> nearest;
    bool interrupted = false;
    std::string gone;  ///< the last request and the reason, if the scanner went away; or empty

    [[nodiscard]] std::size_t count(Verdict verdict) const;
    /// "UST-10LX 2.23.0000, H1614934"
    [[nodiscard]] std::string device() const;
    /// "124 checks: 100 pass, 0 fail, 8 differ as is known, 7 not applicable, 9 skipped"
    [[nodiscard]] std::string summary() const;
    /// "nearest firmware: UST-10LX@2.23.0000: 122 of 122 answers alike"; empty: it was not asked.
    [[nodiscard]] std::string nearness() const;
};

[[nodiscard]] std::string as_text(const CheckReport& report);
[[nodiscard]] std::string as_json(const CheckReport& report);
[[nodiscard]] std::string as_junit(const CheckReport& report);
[[nodiscard]] std::string as_html(const CheckReport& report);

/// A scanner may send anything: what is no printable character of ASCII is a question mark.
[[nodiscard]] std::string in_ascii(std::string_view text);
/// A text as in_ascii() has it, with the entities of XML and HTML.
[[nodiscard]] std::string entities(std::string_view text);

}  // namespace scipd::tools::checks
