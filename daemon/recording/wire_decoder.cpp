// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/recording/wire_decoder.h"

#include <string_view>
#include <variant>

#include "daemon/recording/scip_values.h"
#include "protocol/client/scan_message.h"
#include "protocol/client/scip1_scan.h"

namespace scipd::daemon {

using protocol::client::Message;
using protocol::client::ScanMessage;

std::vector<sim::RecordedScan> WireDecoder::take(const sim::RecordedBytes& bytes) {
    std::vector<sim::RecordedScan> scans;
    if (bytes.way == sim::Way::to_scanner) return scans;
    std::string_view rest = bytes.bytes;
    while (const auto message = decoder_.next(rest))
        take_message(*message, bytes.host_time, scans);
    return scans;
}

void WireDecoder::take_message(const Message& message, sim::HostTime time,
                               std::vector<sim::RecordedScan>& scans) {
    // A status of SCIP 2 has two characters and a sum. That of SCIP 1.1 has one alone, as other
    // texts have, too: there a scan tells.
    if (!message.damage && message.status.size() == 2) ++sound_messages_;
    if (learn_identity(message, identity_)) return;
    if (const auto scan = protocol::client::parse_scip1_scan(message)) {
        ++sound_messages_;
        scans.push_back(recorded_scan(*scan, identity_, time));
        return scans.back().stamp_ms.reset();
    }
    const auto request = protocol::client::parse_scan_echo(message.echo);
    if (!request || request->contents != protocol::Contents::distances) return;
    const auto parsed = parse_scan(message);
    if (const auto* const scan = std::get_if<ScanMessage>(&parsed)) {
        scans.push_back(recorded_scan(*scan, identity_, time));
    } else if (message.damage || !message.lines.empty()) {  // an accepted request has no lines
        ++damaged_scans_;
    }
}

}  // namespace scipd::daemon
