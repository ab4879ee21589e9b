// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The result of one check, and the texts of its sentences. A value; no thread rule.
#pragma once

#include <string>
#include <string_view>

namespace scipd::tools::checks {

enum class Verdict {
    pass,
    fail,
    differs,         ///< from the specification, as is known of this line of products
    not_applicable,  ///< to what the scanner says of itself
    skipped,         ///< it could be made, and was not
};

/// "pass", "fail", "differs", "not applicable", "skipped"
[[nodiscard]] std::string_view name_of(Verdict verdict);

struct [[nodiscard]] Finding {
    Verdict verdict = Verdict::pass;
    std::string why;   ///< a sentence; empty where it passes
    std::string came;  ///< the status that came in place of another, in a reply that is sound

    [[nodiscard]] bool passed() const { return verdict == Verdict::pass; }
};

Finding pass();
Finding fail(std::string why);
Finding not_applicable(std::string why);
Finding skipped(std::string why);
/// Passes if `good`; otherwise it fails for this reason.
Finding require(bool good, std::string why);

/// Printable ASCII as it is, all else as \n, \r, \\ or \xHH. Of long bytes the middle is left out,
/// and their number is given.
[[nodiscard]] std::string printable(std::string_view bytes);

/// A figure with one digit behind the point.
[[nodiscard]] std::string tenths(double value);

}  // namespace scipd::tools::checks
