// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What requests and replies of SCIP 1.1 mean, in words for people who read along. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

#include "protocol/scip1.h"

namespace scipd::protocol {

/// Describes a request: "requests one scan, steps 44 to 725". Empty: SCIP 1.1 has no such request,
/// or not with these parameters.
[[nodiscard]] std::string scip1_request_words(const Scip1Request& request);

/// Describes the reply with this echo and status: "returns the version", "not carried out".
[[nodiscard]] std::string_view scip1_reply_words(const Scip1Request& echo, char status);

/// What the status means. Empty: it means nothing that is known.
[[nodiscard]] std::string_view scip1_status_words(char status);

}  // namespace scipd::protocol
