// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/plot_subject.h"

#include <chrono>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/recording/scip_values.h"
#include "tools/local_time.h"
#include "tools/options.h"
#include "tools/scipcat/recording_target.h"

namespace scipd::tools {
namespace {

/// The parts that are known, with a dot between them.
std::string dotted(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
        if (!part.empty()) text += (text.empty() ? "" : "  ·  ") + part;
    }
    return text;
}

std::string with_word(const std::string& word, const std::string& value) {
    return value.empty() ? value : word + " " + value;
}

}  // namespace

PlotSubject subject_of(ConnectedScanner& scanner, const ScanOptions& options) {
    auto request = options.request(scanner.parameters());
    request.scans = 1;
    scanner.driver().start(request);
    const auto scan = scanner.driver().next_scan();
    scanner.driver().stop();
    const auto identity = daemon::identity_of(scanner.version(), scanner.parameters());
    return {daemon::recorded_scan(scan, identity, std::chrono::system_clock::now()), identity};
}

PlotSubject subject_of(const std::string& file, std::uint64_t number) {
    const auto recording = open_recorded(file);
    for (std::uint64_t count = 1;; ++count) {
        auto item = recording->next();
        if (!item) throw WrongInput(item.error().why);
        if (!*item) throw WrongInput(file + " has " + std::to_string(count - 1) + " scans");
        if (count < number) continue;
        auto& scan = std::get<sim::RecordedScan>((*item)->what);
        return {std::move(scan), recording->streams()[(*item)->stream].identity};
    }
}

std::string scanner_text(const PlotSubject& subject) {
    const sim::ScannerIdentity& identity = subject.identity;
    return dotted({identity.model, with_word("serial", identity.serial),
                   with_word("firmware", identity.firmware)});
}

std::string scan_text(const PlotSubject& subject) {
    const auto& [stamp_ms, time] = std::pair(subject.scan.stamp_ms, subject.scan.host_time);
    return dotted({stamp_ms ? "stamp " + std::to_string(*stamp_ms) + " ms" : "",
                   time ? local_time(*time) : ""});
}

}  // namespace scipd::tools
