// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The pictures of a report, as SVG in the colours of its page. Each is empty where the recording
// does not tell. Any thread; nothing shared.
#pragma once

#include <string>

#include "tools/scipfit/report_view.h"

namespace scipd::tools {

/// What was seen from above, and the walls that were made of it.
[[nodiscard]] std::string room_picture(const Standing& standing, const Room& room);
/// ScanTable of the scanner and of its twin, beam beside beam, scan below scan.
[[nodiscard]] std::string pieces_picture(const ReportView& view);
[[nodiscard]] std::string noise_by_intensity(const ReportView& view, const Fit& fit);
[[nodiscard]] std::string noise_by_range(const ReportView& view);
[[nodiscard]] std::string noise_by_beam(const ReportView& view);
[[nodiscard]] std::string quantile_chart(const ReportView& view);
[[nodiscard]] std::string correlation_chart(const Fit& fit);
[[nodiscard]] std::string code_chart(const CodeShares& codes);
/// How much worse each way to tell the noise is than each beam's own deviation.
[[nodiscard]] std::string held_out_chart(const HeldOut& held_out);

}  // namespace scipd::tools
