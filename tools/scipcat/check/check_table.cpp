// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/check_table.h"

#include <algorithm>

namespace scipd::tools::checks {

std::span<const Chapter> chapters() {
    static const Chapter all[] = {
        {"SCIP 1.1", scip1_checks()},
        {"Identity", identity_checks()},
        {"Sums and framing", framing_checks()},
        {"States", state_checks()},
        {"Single scans", single_scan_checks()},
        {"Streams", stream_checks()},
        {"Clusters", cluster_checks()},
        {"Clock and time stamps", clock_checks()},
        {"Bad requests", bad_request_checks()},
        {"Line ends", line_end_checks()},
        {"Pipelining", pipelining_checks()},
        {"Two clients", two_client_checks()},
        {"Rates", rate_checks()},
        {"Settings, sleep and reboot", unsafe_checks(), true},
    };
    return all;
}

std::string_view chapter_of(std::string_view id) {
    return id.substr(0, id.find('.'));
}

bool is_section(std::string_view section) {
    return std::ranges::any_of(chapters(), [&](const Chapter& chapter) {
        return std::ranges::any_of(
            chapter.checks, [&](const Check& check) { return belongs_to(check.id, section); });
    });
}

bool belongs_to(std::string_view id, std::string_view section) {
    return id == section || chapter_of(id) == section;
}

}  // namespace scipd::tools::checks
