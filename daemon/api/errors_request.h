// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a scanner reads, as JSON: what PATCH /sensors/R/S takes and what the status shows.
#pragma once

#include <string>

#include "daemon/api/documents.h"
#include "daemon/config/reading_errors.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// `now` with the members of the body that differ. A fault names the member.
[[nodiscard]] sim::Expected<ReadingErrors> parse_errors(const std::string& body,
                                                        const ReadingErrors& now);

[[nodiscard]] Json errors_document(const ReadingErrors& errors);

}  // namespace scipd::daemon
