// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/read_tape.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/device/bridge.h"
#include "daemon/models/best_fit.h"
#include "daemon/models/model_registry.h"
#include "daemon/recording/decoded_recording.h"
#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using sim::RecordedScan;
using namespace std::chrono_literals;

constexpr std::uint32_t stamp_mask = (1U << 24U) - 1;
/// A scanner whose clock goes on by more was switched on anew.
constexpr sim::Time longest_gap = 60s;

[[noreturn]] void fail(const ReplayConfig& replay, const std::string& why) {
    throw sim::LoadError({replay.name() + ": " + why});
}

/// Scan after scan of the stream that is wanted.
class ScanReader {
  public:
    explicit ScanReader(const ReplayConfig& replay) : replay_(replay) {
        auto opened = open_scans(replay.files);
        if (!opened) throw sim::LoadError({opened.error().why});
        recording_ = *std::move(opened);
    }

    /// Returns null at the end.
    const RecordedScan* next() {
        while (true) {
            auto item = recording_->next();
            if (!item) throw sim::LoadError({item.error().why});
            if (!*item) return nullptr;
            auto* const scan = std::get_if<RecordedScan>(&(**item).what);
            if (scan == nullptr || !is_wanted((**item).stream)) continue;
            scan_ = std::move(*scan);
            logged_ = (**item).logged;
            // The first one tells from when on the others count.
            if (skip_) recording_->skip_ahead(*std::exchange(skip_, std::nullopt));
            return &scan_;
        }
    }

    /// Scans that come earlier, behind the next one, may be left out.
    void skip_ahead(sim::Time since_first) { skip_ = since_first; }

    /// The scanner of the stream that was read.
    [[nodiscard]] const sim::ScannerIdentity& identity() const {
        return recording_->streams()[stream_.value()].identity;
    }

    [[nodiscard]] std::optional<sim::HostTime> logged() const { return logged_; }

    [[nodiscard]] const std::vector<std::string>& warnings() const {
        return recording_->warnings();
    }

    [[nodiscard]] std::string names() const {
        std::string names;
        for (const sim::RecordedStream& stream : recording_->streams())
            names += (names.empty() ? "" : ", ") + sim::printable(stream.name);
        return names;
    }

  private:
    bool is_wanted(std::size_t stream) {
        const std::string& name = recording_->streams()[stream].name;
        if (!replay_.stream.empty() && name != replay_.stream) return false;
        if (!stream_) stream_ = stream;
        if (*stream_ == stream) return true;
        throw SeveralScanners({replay_.name() + ": has scans of several scanners, " + names() +
                               "; say which with `stream` under `replay` in a configuration"});
    }

    const ReplayConfig& replay_;
    std::unique_ptr<sim::Recording> recording_;
    std::optional<std::size_t> stream_;
    std::optional<sim::Time> skip_;
    RecordedScan scan_;
    std::optional<sim::HostTime> logged_;
};

/// Returns nullopt if the two stamps do not follow each other.
std::optional<sim::Time> follows(sim::Time apart) {
    if (apart > sim::Time::zero() && apart <= longest_gap) return apart;
    return std::nullopt;
}

struct Moment {
    std::optional<std::uint32_t> stamp_ms;
    std::optional<std::uint64_t> stamp_us;
    std::optional<sim::HostTime> host;
    std::optional<sim::HostTime> logged;

    Moment(const RecordedScan& scan, std::optional<sim::HostTime> logged_at)
        : stamp_ms(scan.stamp_ms),
          stamp_us(scan.stamp_us),
          host(scan.host_time),
          logged(logged_at) {}
};

/// Time between two scans: by the scanner's clock if it has one, else by that of the headers, and
/// by the recorder's log time if that jumps. Scans between them may have been left out, up to
/// `unread` and less than a gap.
sim::Time between(const Moment& a, const Moment& b, sim::Time period, sim::Time unread = {}) {
    std::optional<sim::Time> apart;
    if (unread > sim::Time::zero() && a.host && b.host) {
        const auto host = std::chrono::duration_cast<sim::Time>(*b.host - *a.host);
        if (host > 1s && host <= unread + longest_gap) return host;
    }
    if (a.stamp_us && b.stamp_us && *b.stamp_us > *a.stamp_us) {
        apart = follows(std::chrono::microseconds(static_cast<std::int64_t>(
            std::min<std::uint64_t>(*b.stamp_us - *a.stamp_us, 1U << 30U))));
    } else if (a.stamp_ms && b.stamp_ms) {
        apart = follows(std::chrono::milliseconds((*b.stamp_ms - *a.stamp_ms) & stamp_mask));
    }
    const auto later = [](const auto& from, const auto& to) -> std::optional<sim::Time> {
        if (!from || !to || *to <= *from) return std::nullopt;
        return *to - *from;
    };
    if (!apart) apart = later(a.host, b.host);
    const auto logged = later(a.logged, b.logged);
    if (logged && (!apart || *apart > *logged + 1s)) apart = logged;
    return apart.value_or(period);
}

/// The beginning that is never shown, and need not be read: a little less than what comes
/// before from_s, since a scan is in the file a while after its time.
sim::Time unread_of(const ReplayConfig& replay) {
    constexpr sim::Time margin = 2s;
    const bool again = replay.loop != ReplayLoop::none;
    return again ? sim::Time::zero() : std::max<sim::Time>(replay.from - margin, 0s);
}

/// The stamp that a driver sees: the recorded one, or the time since the first scan.
std::uint32_t stamp_of(const RecordedScan& scan, sim::Time begin) {
    if (scan.stamp_ms) return *scan.stamp_ms & stamp_mask;
    if (scan.stamp_us) return static_cast<std::uint32_t>(*scan.stamp_us / 1000) & stamp_mask;
    const auto since = std::chrono::round<std::chrono::milliseconds>(begin);
    return static_cast<std::uint32_t>(since.count()) & stamp_mask;
}

bool has_code(const protocol::DeviceProfile& profile, std::uint32_t code) {
    const protocol::DistanceCodes& codes = profile.codes;
    for (const auto& own :
         {std::optional(codes.nothing), std::optional(codes.too_near), std::optional(codes.too_far),
          std::optional(codes.not_measured), codes.too_dark, codes.too_bright, codes.edge,
          codes.interference, codes.lost}) {
        if (own == code) return true;
    }
    return std::ranges::any_of(profile.rare_codes,
                               [&](const auto& rare) { return rare.code == code; });
}

std::uint32_t distance_of(double range, const RecordedScan& scan,
                          const sim::ScannerIdentity& identity,
                          const protocol::DeviceProfile& profile) {
    if (scan.unit == sim::RangeUnit::millimetres) {
        const bool fits = range >= 0.0 && range < double{1U << 18U};
        return fits ? static_cast<std::uint32_t>(std::lround(range)) : profile.codes.nothing;
    }
    const sim::RecordedReading reading = sim::reading_of(range, scan.unit, identity);
    switch (reading.kind) {
        case sim::RecordedReading::Kind::distance:
            return distance_on_wire(static_cast<float>(reading.range_m), profile);
        case sim::RecordedReading::Kind::too_near:
            return profile.codes.too_near;
        case sim::RecordedReading::Kind::too_far:
            return profile.codes.too_far;
        case sim::RecordedReading::Kind::code:
            if (has_code(profile, reading.code)) return reading.code;
            break;
        case sim::RecordedReading::Kind::nothing:
            break;
    }
    return profile.codes.nothing;
}

std::uint32_t intensity_of(double intensity) {
    constexpr double most = (1U << 18U) - 1;
    if (!(intensity > 0.0)) return 0;
    return static_cast<std::uint32_t>(std::lround(std::min(intensity, most)));
}

protocol::StepEchoes echoes_of(const RecordedScan& scan, std::size_t value,
                               const sim::ScannerIdentity& identity,
                               const protocol::DeviceProfile& profile) {
    const auto ranges = scan.ranges_of(value);
    const auto intensities = scan.intensities_of(value);
    protocol::StepEchoes step;
    step.echo[0].distance = profile.codes.nothing;
    step.count = std::clamp(static_cast<int>(ranges.size()), 1, protocol::max_echoes);
    for (std::size_t i = 0; i < ranges.size() && i < protocol::max_echoes; ++i) {
        step.echo[i] = {distance_of(ranges[i], scan, identity, profile),
                        intensities.empty() ? 0 : intensity_of(intensities[i])};
    }
    return step;
}

using Places = std::vector<std::optional<std::size_t>>;

TapedScan taped(const RecordedScan& scan, const Places& places,
                const sim::ScannerIdentity& identity, const protocol::DeviceProfile& profile) {
    TapedScan taped;
    for (const std::optional<std::size_t>& place : places) {
        protocol::StepEchoes step;
        step.echo[0].distance = profile.codes.nothing;
        if (place) step = echoes_of(scan, *place, identity, profile);
        taped.distance.push_back(step.echo[0].distance);
        taped.intensity.push_back(step.echo[0].intensity);
        if (profile.multi_echo) taped.echoes.push_back(step);
    }
    return taped;
}

Places places_of(const RecordedScan& scan, const Model& model, const ReplayConfig& replay) {
    Places places = map_of_steps(scan, model.optics);
    if (places.empty()) {
        fail(replay, "does not say where its " + std::to_string(scan.steps()) +
                         " values look, and " + model.profile.name + " has " +
                         std::to_string(model.optics.beams()) +
                         " steps; name the model that it was recorded from");
    }
    return places;
}

/// The part of a recording that the model has no step or no range for.
class Loss {
  public:
    Loss(const ReplayConfig& replay, const Model& model) : replay_(replay), model_(model) {}

    /// Values beside a step that is shown, as those of finer recordings, are not lost.
    void see(const RecordedScan& scan, const Places& places) {
        if (!scan.directions.increment_rad) return;
        const double step_rad = model_.optics.beam_rad();
        const double value_rad = std::abs(*scan.directions.increment_rad);
        const auto shown =
            std::ranges::count_if(places, [](const auto& place) { return place.has_value(); });
        const double seen_rad = static_cast<double>(shown) * step_rad;
        const double has_rad =
            std::min(static_cast<double>(scan.steps()) * value_rad, 2.0 * std::numbers::pi);
        lost_rad_ = std::max(lost_rad_, has_rad - seen_rad - 2.0 * std::max(step_rad, value_rad));
    }
    void see_ranges(const RecordedScan& scan, const sim::ScannerIdentity& identity) {
        if (scan.unit != sim::RangeUnit::metres) return;
        for (const double range : scan.ranges) {
            const sim::RecordedReading reading = sim::reading_of(range, scan.unit, identity);
            if (reading.kind == sim::RecordedReading::Kind::distance)
                farthest_m_ = std::max(farthest_m_, reading.range_m);
        }
    }

    void report(std::vector<std::string>& warnings) const {
        constexpr double deg_per_rad = 180.0 / std::numbers::pi;
        const std::string begin = replay_.name() + ": " + model_.profile.name;
        if (lost_rad_ > 0.0)
            warnings.push_back(begin + " has no steps for " + rounded(lost_rad_ * deg_per_rad) +
                               " degrees of the scans, which are left out" + way_out());
        if (farthest_m_ > model_.optics.max_range_m + 0.001)
            warnings.push_back(begin + " reports up to " + rounded(model_.optics.max_range_m) +
                               " m, and the scans have distances up to " + rounded(farthest_m_) +
                               " m, which become its code for too far" + way_out());
    }

  private:
    [[nodiscard]] std::string way_out() const {
        return replay_.finds_model
                   ? ""
                   : "; leave the model out, and the scanner has what the recording has";
    }
    static std::string rounded(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.4g", value);
        return text;
    }

    const ReplayConfig& replay_;
    const Model& model_;
    double lost_rad_ = 0.0;
    double farthest_m_ = 0.0;
};

double rate_between(const Moment& a, const Moment& b) {
    const auto apart = between(a, b, sim::Time::zero());
    return apart > sim::Time::zero() ? 1.0 / std::chrono::duration<double>(apart).count() : 0.0;
}

using Places = std::vector<std::optional<std::size_t>>;

std::optional<std::size_t> within(double place, std::size_t count) {
    // In a fan with an even number of directions all steps lie between two of them.
    constexpr double tie = 1e-6;
    const double nearest = std::floor(place + 0.5 + tie);
    if (nearest < 0.0 || nearest >= static_cast<double>(count)) return std::nullopt;
    return static_cast<std::size_t>(nearest);
}

Places by_steps(const sim::RecordedScan& scan, int first, const sim::SensorSpec& optics) {
    Places places;
    for (int step = optics.first_step; step <= optics.last_step; ++step) {
        // A value of a cluster stands for all of its steps.
        const int into = step - first;
        const double place = into < 0 ? -1.0 : std::floor(double(into) / scan.directions.cluster);
        places.push_back(within(place, scan.steps()));
    }
    return places;
}

/// Angles are modulo a turn: recordings begin anywhere, and go either way. Where a round scan has
/// its first direction a second time at its end, the first one counts.
Places by_angles(const sim::RecordedScan& scan, const sim::SensorSpec& optics) {
    const double first_rad = *scan.directions.first_rad;
    const double increment_rad = *scan.directions.increment_rad;
    // A fan with an even number of directions has none ahead, where SCIP has a step: its values lie
    // half a step beside all steps, and rounding would take one of them twice.
    constexpr double beside = 0.75;
    const auto off = [&](int step, double value) {
        return std::abs((optics.angle_rad(step) - first_rad) / increment_rad - value);
    };
    const auto last = static_cast<double>(scan.steps()) - 1.0;
    if (scan.steps() == static_cast<std::size_t>(optics.beams()) &&
        off(optics.first_step, 0.0) < beside && off(optics.last_step, last) < beside)
        return by_steps(scan, optics.first_step, optics);
    const double values_of_turn = 2.0 * std::numbers::pi / std::abs(increment_rad);
    // Angles of 32 bits may leave a gap of less than a value where a round scan closes.
    const double most = last + 1.5 > values_of_turn ? last : values_of_turn;
    Places places;
    for (int step = optics.first_step; step <= optics.last_step; ++step) {
        const double place = (optics.angle_rad(step) - first_rad) / increment_rad;
        const double within_turn =
            place - std::floor((place + 0.5) / values_of_turn) * values_of_turn;
        places.push_back(within(std::min(within_turn, most), scan.steps()));
    }
    return places;
}

}  // namespace

RecordedScanner recorded_scanner(const ReplayConfig& replay) {
    ScanReader reader(replay);
    const RecordedScan* const first = reader.next();
    if (first == nullptr) {
        fail(replay, replay.stream.empty() ? "holds no scan"
                                           : "has no scans of " + sim::quote(replay.stream) +
                                                 "; it has those of " + reader.names());
    }
    const RecordedScan scan = *first;
    RecordedScanner scanner{
        .identity = reader.identity(), .first = scan.host_time, .logged = reader.logged()};
    if (!replay.finds_model) return scanner;
    if (const Model* const model = model_named_in(scanner.identity.model)) {
        scanner.model = *model;
        return scanner;
    }
    if (!scan.directions.first_rad || !scan.directions.increment_rad) {
        fail(replay,
             "does not name the scanner's model; name it (--model, or `model` in a "
             "configuration), one of `scipd --list-models`");
    }
    const RecordedScan* const second = reader.next();
    const double rate_hz = second == nullptr ? 0.0
                                             : rate_between(Moment(scan, scanner.logged),
                                                            Moment(*second, reader.logged()));
    scanner.model =
        recorded_model(recorded_lidar(scan.directions, scan.steps(), scanner.identity, rate_hz));
    return scanner;
}

std::vector<std::string> recorded_streams(const ReplayConfig& replay, const std::stop_token& stop) {
    const auto recording = open_scans(replay.files);
    if (!recording) throw sim::LoadError({recording.error().why});
    std::set<std::size_t> streams;
    while (true) {
        if (stop.stop_requested()) throw sim::LoadError({"scipd ends"});
        const auto item = (*recording)->next();
        if (!item) throw sim::LoadError({item.error().why});
        if (!*item) break;
        if (std::holds_alternative<RecordedScan>((**item).what)) streams.insert((**item).stream);
    }
    std::vector<std::string> names;
    for (const std::size_t stream : streams)
        names.push_back((*recording)->streams()[stream].name);
    return names;
}

std::shared_ptr<Tape> read_tape(const ReplayConfig& replay, const Model& model,
                                std::vector<std::string>& warnings, const std::stop_token& stop) {
    ScanReader reader(replay);
    Loss loss(replay, model);
    const bool with_echoes = model.profile.multi_echo;
    const auto period = std::chrono::duration_cast<sim::Time>(model.optics.scan_period);
    const auto tape =
        std::make_shared<Tape>(static_cast<std::size_t>(model.optics.beams()), with_echoes);
    const sim::Time unread = unread_of(replay);
    if (unread > sim::Time::zero()) reader.skip_ahead(unread);
    sim::Time begin{};
    std::optional<Moment> before;
    std::optional<std::pair<sim::Directions, std::size_t>> mapped;
    Places places;
    while (const RecordedScan* const scan = reader.next()) {
        if (stop.stop_requested()) throw sim::LoadError({"scipd ends"});
        const Moment now(*scan, reader.logged());
        if (before) begin += between(*before, now, period, unread);
        if (!before && now.host) tape->set_recorded(now.host->time_since_epoch());
        before = now;
        if (begin < unread) continue;
        if (const std::pair is{scan->directions, scan->steps()}; mapped != is) {
            places = places_of(*scan, model, replay);
            loss.see(*scan, places);
            mapped = is;
        }
        try {
            loss.see_ranges(*scan, reader.identity());
            tape->add(taped(*scan, places, reader.identity(), model.profile),
                      stamp_of(*scan, begin), begin);
        } catch (const std::runtime_error& error) {
            fail(replay, error.what());
        }
    }
    if (tape->size() == 0 && before) fail(replay, "has no scan from from_s on");
    if (tape->size() == 0) fail(replay, "holds no scan");
    tape->end(period);
    for (const std::string& warning : reader.warnings())
        warnings.push_back(replay.name() + ": " + warning);
    loss.report(warnings);
    if (replay.begins_s && std::holds_alternative<AsRecorded>(*replay.begins_s) &&
        !tape->recorded())
        fail(replay, "has no date: give begins_s as a stamp in seconds");
    return tape;
}

Places map_of_steps(const sim::RecordedScan& scan, const sim::SensorSpec& optics) {
    const sim::Directions& directions = scan.directions;
    if (directions.first_step) return by_steps(scan, *directions.first_step, optics);
    if (directions.first_rad && directions.increment_rad && *directions.increment_rad != 0.0)
        return by_angles(scan, optics);
    if (scan.steps() == static_cast<std::size_t>(optics.beams()))
        return by_steps(scan, optics.first_step, optics);
    return {};
}

}  // namespace scipd::daemon
