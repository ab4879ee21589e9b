// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Requests, replies and statuses in words, of SCIP 2.0 and 1.1, for people who read along. Pure;
// any thread.
#pragma once

#include <string>
#include <string_view>

#include "protocol/command.h"
#include "protocol/request.h"
#include "protocol/scip1.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// Describes a request: "requests an endless stream of distances, steps 0 to 1080". Of a command
/// that the model does not know it says so.
[[nodiscard]] std::string request_words(const Request& request);

/// Describes the reply with this echo and status: "returns the version", "refuses",
/// "a scan of the stream, and 9 more to come".
[[nodiscard]] std::string reply_words(const Request& echo, Status status);

/// What the status means in a reply to this command. Null: a command that the model does not know.
/// Empty: it means nothing that is known.
[[nodiscard]] std::string_view status_words(const Command* command, Status status);

/// Describes a request: "requests one scan, steps 44 to 725". Empty: SCIP 1.1 has no such request,
/// or not with these parameters.
[[nodiscard]] std::string scip1_request_words(const Scip1Request& request);

/// Describes the reply with this echo and status: "returns the version", "not carried out".
[[nodiscard]] std::string_view scip1_reply_words(const Scip1Request& echo, char status);

/// The meaning of the status; empty if it has none that is known.
[[nodiscard]] std::string_view scip1_status_words(char status);

}  // namespace scipd::protocol
