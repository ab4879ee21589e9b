// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/scan_table.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <ranges>
#include <utility>

#include "daemon/recording/decoded_recording.h"
#include "sim/recording/recording_files.h"
#include "sim/text/quote.h"
#include "tools/options.h"
#include "tools/scan_progress.h"

namespace scipd::tools {
namespace {

using Kind = sim::RecordedReading::Kind;

Code code_in_place(const sim::RecordedReading& reading, double value, sim::RangeUnit unit) {
    constexpr double most_sent = 1U << 18U;
    if (reading.kind == Kind::code) return static_cast<Code>(reading.code);
    if (unit == sim::RangeUnit::millimetres && value >= 0.0 && value < most_sent)
        return static_cast<Code>(std::lround(value));
    if (reading.kind == Kind::nothing) return codes::nothing;
    return reading.kind == Kind::too_near ? codes::too_near : codes::too_far;
}

/// The stamp after one that is known, where 24 bits have wrapped in between.
double unwrapped_s(double before_s, std::uint32_t stamp_ms) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    const double stamp_s = stamp_ms / 1e3;
    return stamp_s + wrap_s * std::round((before_s - stamp_s) / wrap_s);
}

std::string names_of(const sim::Recording& recording) {
    return sim::listed(recording.streams() | std::views::transform(&sim::RecordedStream::name));
}

/// Metres in 32 bits are not quite the millimetres that were sent.
bool is_nearly_whole(float mm) {
    constexpr float rounded = 0.02F;
    return !is_distance(mm) || std::abs(mm - std::round(mm)) < rounded;
}

}  // namespace

Code class_of(Code code) {
    constexpr Code first_distance = 20;  // SCIP 2.0: codes are smaller
    return code == codes::distance || (code > 1 && code < first_distance) ? code : codes::nothing;
}

std::string name_of_code(Code code) {
    if (code == codes::distance) return "a distance";
    return class_of(code) == codes::nothing ? "no distance" : std::to_string(code);
}

Reading reading_at(const sim::RecordedScan& scan, std::size_t beam, Echo echo,
                   const sim::ScannerIdentity& identity) {
    const auto ranges = scan.ranges_of(beam);
    const auto intensities = scan.intensities_of(beam);
    if (ranges.empty()) return {};
    const std::ptrdiff_t at = echo == Echo::first || intensities.empty()
                                  ? 0
                                  : std::ranges::max_element(intensities) - intensities.begin();
    const double value = ranges[static_cast<std::size_t>(at)];
    const sim::RecordedReading reading = sim::reading_of(value, scan.unit, identity);
    if (reading.kind != Kind::distance)
        return {no_number, no_number, code_in_place(reading, value, scan.unit)};
    const double light =
        intensities.empty() ? no_number : intensities[static_cast<std::size_t>(at)];
    return {static_cast<float>(reading.range_m * 1e3),
            std::isfinite(light) ? static_cast<float>(light) : no_number, codes::distance};
}

void ScanTable::add(const sim::RecordedScan& scan, bool stamped) {
    if (!looks_alike(scan)) {
        ++odd_ones;
        return;
    }
    append(scan, stamped);
    if (!last_came_twice()) return;
    ++doubles;
    resize(scans() - 1);
}

bool ScanTable::looks_alike(const sim::RecordedScan& scan) const {
    if (beams == 0) return scan.steps() > 0;
    if (scan.steps() != beams) return false;
    const sim::Directions& other = scan.directions;
    if (directions.first_step && other.first_step)
        return directions.first_step == other.first_step && directions.cluster == other.cluster;
    if (!directions.first_rad || !directions.increment_rad || !other.first_rad ||
        !other.increment_rad)
        return true;
    const double first_rad = *other.first_rad - *directions.first_rad;
    const double last_rad = first_rad + (*other.increment_rad - *directions.increment_rad) *
                                            static_cast<double>(beams - 1);
    return std::max(std::abs(first_rad), std::abs(last_rad)) <
           std::abs(*directions.increment_rad) / 2;
}

void ScanTable::append(const sim::RecordedScan& scan, bool stamped) {
    if (beams == 0) {
        beams = scan.steps();
        directions = scan.directions;
    }
    has_codes = has_codes || scan.unit == sim::RangeUnit::millimetres;
    const bool lit = !intensities.empty() || !scan.intensities.empty();
    if (lit) intensities.resize(ranges_mm.size(), no_number);
    for (std::size_t beam = 0; beam < beams; ++beam) {
        const Reading reading = reading_at(scan, beam, echo, identity);
        ranges_mm.push_back(reading.range_mm);
        codes.push_back(reading.code);
        if (lit) intensities.push_back(reading.intensity);
        has_codes = has_codes || reading.code >= 0;
    }
    add_time(scan, stamped);
}

void ScanTable::add_time(const sim::RecordedScan& scan, bool stamped) {
    ScanTime time{.stamped = stamped};
    if (scan.stamp_us) {
        time.stamp_s = static_cast<double>(*scan.stamp_us) / 1e6;
        tick_s = 1e-6;
    } else if (scan.stamp_ms) {
        const auto before = times.empty() ? std::nullopt : times.back().stamp_s;
        time.stamp_s = before ? unwrapped_s(*before, *scan.stamp_ms) : *scan.stamp_ms / 1e3;
    }
    if (scan.host_time) {
        if (!first_host_time) first_host_time = scan.host_time;
        time.host_s = std::chrono::duration<double>(*scan.host_time - *first_host_time).count();
    }
    times.push_back(time);
}

bool ScanTable::last_came_twice() const {
    const std::size_t last = scans() - 1;
    if (last <= begins.back()) return false;
    const ScanTime& time = times[last];
    const ScanTime& before = times[last - 1];
    if (time.stamp_s && before.stamp_s) {
        if (time.stamp_s != before.stamp_s) return false;
    } else if (time.stamped && before.stamped && time.host_s != before.host_s) {
        return false;
    }
    const auto repeats = [&](const auto& column) {
        if (column.empty()) return true;
        const auto now = column.end() - static_cast<std::ptrdiff_t>(beams);
        return std::equal(now, column.end(), now - static_cast<std::ptrdiff_t>(beams),
                          [](auto a, auto b) { return a == b || (a != a && b != b); });
    };
    return repeats(ranges_mm) && repeats(codes) && repeats(intensities);
}

void ScanTable::resize(std::size_t scans) {
    ranges_mm.resize(scans * beams);
    if (!intensities.empty()) intensities.resize(scans * beams);
    codes.resize(scans * beams);
    times.resize(scans);
}

void ScanTable::clear() {
    resize(0);
    beams = 0;
}

void ScanTable::end_recording() {
    begins.push_back(scans());
    whole_mm = std::ranges::all_of(ranges_mm, is_nearly_whole);
    if (!whole_mm) return;
    for (float& mm : ranges_mm)
        mm = std::round(mm);
}

void ScanTable::limit(double nearest_mm, double farthest_mm) {
    const auto nearest = static_cast<float>(nearest_mm);
    const auto farthest = static_cast<float>(farthest_mm);
    for (std::size_t i = 0; i < ranges_mm.size(); ++i) {
        const float mm = ranges_mm[i];
        if (!is_distance(mm) || (mm >= nearest && mm <= farthest)) continue;
        const Code beyond = mm < nearest ? codes::too_near : codes::too_far;
        codes[i] = has_codes ? static_cast<Code>(std::lround(mm)) : beyond;
        ranges_mm[i] = no_number;
        if (!intensities.empty()) intensities[i] = no_number;
    }
}

bool ScanTable::has_intensities() const {
    return std::ranges::any_of(intensities, [](float intensity) { return intensity > 0.0F; });
}

double ScanTable::period_s() const {
    for (std::size_t i = 1; i < begins.size(); ++i) {
        if (begins[i] < begins[i - 1] + 2) continue;
        const auto first_s = times[begins[i - 1]].host_s;
        const auto last_s = times[begins[i] - 1].host_s;
        if (first_s && last_s)
            return (*last_s - *first_s) / static_cast<double>(begins[i] - 1 - begins[i - 1]);
    }
    return 0.0;
}

bool is_recording(const std::string& target) {
    std::error_code error;
    const auto status = std::filesystem::status(sim::split_paths(target).front(), error);
    return std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status);
}

std::unique_ptr<sim::Recording> open_recorded(const std::string& target) {
    auto recording = daemon::open_scans(sim::split_paths(target));
    if (!recording) throw WrongInput(recording.error().why);
    return *std::move(recording);
}

std::size_t for_each_scan(sim::Recording& recording, const std::string& name,
                          const ScanChoice& choice, const TakeScan& take) {
    std::optional<std::size_t> chosen;
    {
        ScanProgress progress(choice.progress);
        for (std::size_t scans = 0;;) {
            const auto item = recording.next();
            if (!item) throw WrongInput(item.error().why);
            if (!*item) break;
            const std::size_t at = (*item)->stream;
            const sim::RecordedStream& stream = recording.streams()[at];
            if (!chosen && (choice.stream.empty() || stream.name == choice.stream)) chosen = at;
            if (chosen != at) continue;
            const auto& scan = std::get<sim::RecordedScan>((*item)->what);
            progress.tell(++scans);
            if (!take(scan, stream, (*item)->stamped)) break;
        }
    }
    if (!chosen && !choice.stream.empty())
        throw WrongInput(name + " has no stream \"" + choice.stream + "\" with scans; it has " +
                         names_of(recording));
    if (!chosen) throw WrongInput(name + ": holds no scans");
    for (const std::string& warning : recording.warnings())
        std::cerr << warning << '\n';
    if (choice.stream.empty() && recording.streams().size() > 1)
        std::cerr << name << ": has several scanners, " << names_of(recording) << "; "
                  << choice.option << " names one, and the first is taken\n";
    return *chosen;
}

std::size_t read_scans(sim::Recording& recording, const std::string& name, const ScanChoice& choice,
                       ScanTable& table) {
    const std::size_t scans_before = table.scans();
    const std::size_t odd_before = table.odd_ones;
    const std::string known = table.identity.model;
    table.echo = choice.echo;
    const auto take = [&](const auto& scan, const auto& stream, bool stamped) {
        if (known.empty() && table.identity != stream.identity) table.identity = stream.identity;
        table.add(scan, stamped);
        return choice.most == 0 || table.scans() - scans_before < choice.most;
    };
    const std::size_t stream = for_each_scan(recording, name, choice, take);
    const std::string& model = recording.streams()[stream].identity.model;
    if (!known.empty() && !model.empty() && model != known)
        throw WrongInput(name + ": is of a " + model + ", the recording before of a " + known +
                         "; name recordings of one scanner");
    const std::size_t odd = table.odd_ones - odd_before;
    const std::string left_out = name + ": " + std::to_string(odd) +
                                 " scans have other steps than " + "the first of " +
                                 std::to_string(table.beams);
    if (odd > table.scans() - scans_before)
        throw WrongInput(left_out + "; name recordings of one scanner with the same steps");
    if (odd > 0) std::cerr << left_out << ", and are left out\n";
    table.end_recording();
    const std::string file = std::filesystem::path(name).filename().string();
    table.files += (table.files.empty() ? "" : ", ") + file;
    return stream;
}

}  // namespace scipd::tools
