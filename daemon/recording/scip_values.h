// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner says in SCIP, as the values of a recording. Any thread; nothing shared.
#pragma once

#include "protocol/client/device_info.h"
#include "protocol/client/message.h"
#include "protocol/client/scan_message.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::daemon {

/// Takes over what an answer to VV, PP or II says, or to V of SCIP 1.1. False: the message is
/// another one, or damaged.
bool learn_identity(const protocol::client::Message& message, sim::ScannerIdentity& identity);

/// Who a scanner is by its answers to VV and PP.
[[nodiscard]] sim::ScannerIdentity identity_of(const protocol::client::Version& version,
                                               const protocol::client::Parameters& parameters);

/// The scan with the angles of its steps, if the identity has the scanner's parameters. The request
/// was for distances.
[[nodiscard]] sim::RecordedScan recorded_scan(const protocol::client::ScanMessage& scan,
                                              const sim::ScannerIdentity& identity,
                                              sim::HostTime received);

}  // namespace scipd::daemon
