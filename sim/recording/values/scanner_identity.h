// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which scanner a recording is of, as far as its file says. A value; no thread rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scipd::sim {

/// "SERI" and "H1614934": a line of what a scanner says of itself.
struct Entry {
    std::string key;
    std::string value;

    bool operator==(const Entry&) const = default;
};
using Entries = std::vector<Entry>;

/// What is not known is empty.
struct ScannerIdentity {
    std::string model;
    std::string serial;
    std::string firmware;
    // Ranges outside of these are codes, or none.
    std::optional<double> min_range_m;
    std::optional<double> max_range_m;
    std::optional<int> steps_per_turn;
    std::optional<int> front_step;  ///< the step that looks forward
    std::optional<double> rpm;
    // The scanner's answers to VV, PP and II, whole and in their order.
    Entries version;
    Entries parameters;
    Entries state;

    bool operator==(const ScannerIdentity&) const = default;
};

/// The value of the entry with this key; empty if there is none.
[[nodiscard]] inline std::string value_of(const Entries& entries, const std::string& key) {
    for (const Entry& entry : entries) {
        if (entry.key == key) return entry.value;
    }
    return {};
}

/// An identity as entries, which formats of their own metadata hold: model, serial, and so on, then
/// each line of the scanner's answers as VV.KEY, PP.KEY and II.KEY. Facts not known are left out.
[[nodiscard]] Entries entries_of(const ScannerIdentity& identity);
/// Leaves out entries of other keys.
[[nodiscard]] ScannerIdentity identity_in(const Entries& entries);

}  // namespace scipd::sim
