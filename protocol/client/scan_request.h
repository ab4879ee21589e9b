// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes the requests for scans as text, and reads them back. The echo of a scan message tells all
// that is needed to read the message. Which command brings which data is read from the scanner's
// own command table. Values; no thread rule.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/step_window.h"

namespace scipd::protocol::client {

struct ScanRequest {
    int first_step = 0;  ///< first and last are inclusive
    int last_step = 0;
    int cluster = 1;  ///< neighbouring steps that share one value
    int width = 3;    ///< characters of a value; 2 only without intensity and echoes
    bool intensity = false;
    bool echoes = false;        ///< all echoes of a step, not only one
    bool io_lines = false;      ///< with the scanner's inputs and outputs; not with echoes
    bool microseconds = false;  ///< unit of the stamp; only streams without echoes
    int interval = 0;           ///< scans to skip after each; streams only
    int scans = 0;              ///< 0: until told to stop; streams only
    /// In an echo only: what the values are. The cluster may then be one of a URG-04LX's codes.
    Contents contents = Contents::distances;

    /// The last group is shorter if the window does not divide evenly.
    [[nodiscard]] std::size_t groups() const;

    bool operator==(const ScanRequest&) const = default;
};

/// GD, GS, GE, HD, HE, GF, GG: the latest complete scan. This and stream_line() throw
/// std::invalid_argument if no command brings such scans.
[[nodiscard]] std::string single_scan_line(const ScanRequest& request);
/// MD, MS, ME, ND, NE, MF, MG, %MD, %ME: scan after scan.
[[nodiscard]] std::string stream_line(const ScanRequest& request);

/// What the echo of a scan message says. `scans` is how many are still to come. Nothing if the echo
/// is of none of the commands above.
[[nodiscard]] std::optional<ScanRequest> parse_scan_echo(std::string_view echo);

}  // namespace scipd::protocol::client
