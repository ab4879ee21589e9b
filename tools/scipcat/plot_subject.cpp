// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/plot_subject.h"

#include <chrono>
#include <utility>
#include <vector>

#include "daemon/models/model_registry.h"
#include "daemon/recording/scip_values.h"
#include "tools/analysis/scan_table.h"
#include "tools/local_time.h"
#include "tools/options.h"

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

template <class Value>
void fill(std::optional<Value>& known, Value value) {
    if (!known) known = value;
}

void fill(sim::ScannerIdentity& identity, const protocol::DeviceProfile& profile) {
    constexpr double m_per_mm = 1e-3;
    if (identity.model.empty()) identity.model = profile.name.substr(0, profile.name.find('@'));
    fill(identity.min_range_m, profile.dmin_mm * m_per_mm);
    fill(identity.max_range_m, profile.dmax_mm * m_per_mm);
    fill(identity.steps_per_turn, profile.ares);
    fill(identity.front_step, profile.afrt);
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

PlotSubject subject_of(const std::string& file, const std::string& stream, std::uint64_t number) {
    const auto recording = open_recorded(file);
    PlotSubject subject;
    std::uint64_t count = 0;
    for_each_scan(*recording, file, {.stream = stream},
                  [&](const auto& scan, const auto& of, bool) {
                      if (++count == number) subject = {scan, of.identity};
                      return count < number;
                  });
    if (count < number) throw WrongInput(file + " has " + std::to_string(count) + " scans");
    return subject;
}

void take_for_model(PlotSubject& subject, const std::string& name) {
    const auto model = daemon::model_named(name);
    if (!model) throw WrongInput("--model: " + model.error().why);
    const protocol::DeviceProfile& profile = model->profile;
    fill(subject.identity, profile);
    sim::Directions& directions = subject.scan.directions;
    if (directions.first_rad && directions.increment_rad) return;
    const auto steps = static_cast<std::size_t>(profile.amax - profile.amin + 1);
    if (!directions.first_step && subject.scan.steps() != steps)
        throw WrongInput("the scan does not say where its " + std::to_string(subject.scan.steps()) +
                         " values look, and " + name + " has " + std::to_string(steps) +
                         " steps; name the model that it was recorded from");
    if (!directions.first_step) directions.first_step = profile.amin;
    directions = sim::with_angles(directions, subject.identity);
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
