// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What came of one check. A value; no thread rule.
#pragma once

#include <string>
#include <string_view>

namespace scipd::tools::checks {

enum class Verdict {
    pass,
    fail,
    differs,         ///< from the specification, as is known of this line of products
    not_applicable,  ///< to what the scanner says of itself
};

/// "pass", "fail", "differs", "not applicable"
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
/// Passes if `good`; otherwise it fails for this reason.
Finding require(bool good, std::string why);

}  // namespace scipd::tools::checks
