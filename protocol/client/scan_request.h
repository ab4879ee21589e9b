// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The requests for scans, as text and back. The echo of a scan message says all that is needed to
// read it. Which command brings what is read from the scanner's own command table. Values; no
// thread rule.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/step_window.h"

namespace scipd::protocol::client {

struct ScanRequest {
    int first_step = 0;  ///< both inclusive
    int last_step = 0;
    int cluster = 1;  ///< so many neighbouring steps give one value
    int width = 3;    ///< characters a value; 2 only with neither intensity nor echoes
    bool intensity = false;
    bool echoes = false;        ///< every echo of a step, not one only
    bool io_lines = false;      ///< with the scanner's inputs and outputs; not with echoes
    bool microseconds = false;  ///< the stamp is in these; streams without echoes only
    int interval = 0;           ///< scans passed over between two; streams only
    int scans = 0;              ///< 0: until told to stop; streams only
    /// In an echo only: what the values are. The cluster may be one of a URG-04LX's codes.
    Contents contents = Contents::distances;

    /// The last group is shorter where the window does not divide evenly.
    [[nodiscard]] std::size_t groups() const;

    bool operator==(const ScanRequest&) const = default;
};

/// GD, GS, GE, HD, HE, GF, GG: the latest complete scan. Like stream_line(), throws
/// std::invalid_argument where no command brings such scans.
[[nodiscard]] std::string single_scan_line(const ScanRequest& request);
/// MD, MS, ME, ND, NE, MF, MG, %MD, %ME: scan after scan.
[[nodiscard]] std::string stream_line(const ScanRequest& request);

/// What the echo of a scan message says; `scans` is how many are still to come. Nothing where it is
/// none of the commands above.
[[nodiscard]] std::optional<ScanRequest> parse_scan_echo(std::string_view echo);

}  // namespace scipd::protocol::client
