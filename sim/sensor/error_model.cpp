// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/error_model.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/recycled.h"
#include "sim/sensor/code_chance.h"
#include "sim/sensor/curve.h"
#include "sim/sensor/echo.h"
#include "sim/sensor/noise_law.h"
#include "sim/sensor/noise_row.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/sensor/spec_curves.h"
#include "sim/sensor/unit_bias.h"
#include "sim/time.h"

namespace scipd::sim {
namespace {

/// The last errors, which all ranges of a scan have: the drift of a unit that warms up, and the
/// lattice that its ranges lie on. A small value, since compilers take several ranges at once only
/// if they see that it stays as it is.
class LastErrors {
  public:
    LastErrors(const SensorSpec& spec, Time on_for)
        : drift_m_(drift_m(spec.warm_up, on_for)),
          lattice_m_(spec.lattice_m >= finest_lattice_m ? spec.lattice_m : 0.0),
          per_lattice_(lattice_m_ > 0.0 ? 1.0 / lattice_m_ : 0.0) {}

    [[nodiscard]] float told_m(double range_m) const {
        // In this order what is no number becomes one.
        const double read_m = std::min(std::max(0.0, range_m + drift_m_), farthest_m);
        if (lattice_m_ == 0.0) return static_cast<float>(read_m);
        // A conversion is several times faster than std::round().
        const auto places = static_cast<std::int32_t>(read_m * per_lattice_ + 0.5);
        return static_cast<float>(places * lattice_m_);
    }

  private:
    /// No scanner tells more, nor finer. So a place on a lattice is an int.
    static constexpr double farthest_m = 20'000.0;
    static constexpr double finest_lattice_m = 1e-5;

    [[nodiscard]] static double drift_m(const WarmUp& warm_up, Time on_for) {
        if (warm_up.drift_m == 0.0) return 0.0;
        const std::chrono::duration<double> on_for_s = on_for;
        const std::chrono::duration<double> constant_s = warm_up.time_constant;
        return warm_up.drift_m * std::exp(-on_for_s / constant_s);
    }

    double drift_m_;
    double lattice_m_;
    double per_lattice_;
};

/// The share of the spread within a footprint that shows as noise. Recorded walls that are met
/// at 40 to 75 degrees leave no room for more.
inline constexpr double spread_share = 0.02;

/// The standard deviation of a range, by the light that comes back (noise_law.h). Made for one
/// scan.
class Deviation {
  public:
    /// Multiplies `curves` by the factor; they must outlive it.
    Deviation(const NoiseLaw& law, const SpecCurves& curves, double factor);

    /// For a white wall that is met head-on.
    [[nodiscard]] double of_white_wall_m(double range_m) {
        return factor_ * white_wall_.at(range_m);
    }

    /// Light of less power than a white wall's leaves more noise: at most as much as that of the
    /// darkest target that is still seen.
    [[nodiscard]] double of_m(const Echo& echo);

  private:
    double factor_;
    double weak_;
    double faintest_intensity_;
    Curve::Cursor white_wall_;
    Curve::Cursor intensity_;
};

double square(double x) {
    return x * x;
}

Deviation::Deviation(const NoiseLaw& law, const SpecCurves& curves, double factor)
    : factor_(factor),
      weak_(law.weak),
      faintest_intensity_(curves.faintest_intensity),
      white_wall_(curves.white_wall),
      intensity_(curves.intensity) {}

double Deviation::of_m(const Echo& echo) {
    double variance_m2 = square(white_wall_.at(echo.range_m));
    if (const double white = intensity_.at(echo.range_m); white > 0.0) {
        const double intensity = std::max(white * echo.power, faintest_intensity_);
        variance_m2 *= (1.0 + square(weak_ / intensity)) / (1.0 + square(weak_ / white));
    }
    return factor_ * std::sqrt(variance_m2 + square(spread_share * echo.spread_m));
}

/// So that the echoes of one beam do not share their chance.
constexpr std::uint32_t beams_apart = 1U << 20U;
/// More echoes of one beam are not looked at.
constexpr std::size_t most_echoes_read = 8;

ChanceKey with_purpose(ChanceKey key, Purpose purpose) {
    key.purpose = purpose;
    return key;
}

/// Reads the echoes of one scan.
class Reader {
  public:
    Reader(const SensorSpec& spec, const SpecCurves& curves, const ErrorModel& model, Time on_for,
           std::int64_t revolution)
        : spec_(spec),
          bias_(curves.bias),
          deviation_(spec.noise_law, curves, model.noise_factor),
          intensity_(curves.intensity),
          intensity_noise_(curves.intensity_noise),
          noise_factor_(model.noise_factor),
          last_errors_(spec, on_for),
          weakest_(weakest_signal(spec.receiver)),
          noise_(with_purpose(model.key(revolution), Purpose::range_noise)),
          noticing_(with_purpose(model.key(revolution), Purpose::detection)),
          losing_(with_purpose(model.key(revolution), Purpose::lost_beams)),
          flicker_(with_purpose(model.key(revolution), Purpose::intensity_noise)) {}

    /// The reading of a hit without errors. It fills a reading in place, member by member: a
    /// Reading that is returned is copied in pieces that the processor has to wait for, which took
    /// a tenth of a whole revolution.
    void read_ideal(const Hit& hit, Reading& reading) {
        reading = {};
        if (!hit.met()) return;
        reading.range_m = hit.range_m;
        reading.intensity = intensity_of(intensity_.at(hit.range_m) * hit.cos_incidence);
        reading.cause = Cause::measured;
    }
    [[nodiscard]] double sigma_m(const Hit& hit) { return deviation_.of_white_wall_m(hit.range_m); }

    /// Adds the errors that follow from the range alone to a reading without.
    void add_errors(Reading& reading, std::uint32_t beam, double noise_m) {
        if (loses(beam))
            reading = {.cause = Cause::lost};
        else
            reading.range_m = last_errors_.told_m(biased_m(reading.range_m) + noise_m);
    }
    /// Adds the errors of all beams from 0 on, in short runs, of whose beams the compiler takes
    /// several at once: one after the other took 3 % of a revolution longer.
    void add_errors(std::span<Reading> readings, std::span<const float> noise_m) {
        constexpr std::size_t run = 64;
        const LastErrors last_errors = last_errors_;
        std::array<double, run> biased{};
        std::array<float, run> told;
        for (std::size_t first = 0; first < readings.size(); first += run) {
            const auto here = readings.subspan(first, std::min(run, readings.size() - first));
            for (std::size_t i = 0; i < here.size(); ++i)
                if (here[i].cause == Cause::measured) biased[i] = biased_m(here[i].range_m);
            for (std::size_t i = 0; i < here.size(); ++i)
                told[i] = last_errors.told_m(biased[i] + noise_m[first + i]);
            for (std::size_t i = 0; i < here.size(); ++i)
                if (here[i].cause == Cause::measured) here[i].range_m = told[i];
        }
        lose_some(readings);
    }
    [[nodiscard]] const Chance& noise() const { return noise_; }

    /// The noise of the echoes of all beams, those of one rank in one row.
    [[nodiscard]] std::vector<NoiseRow> noise_of(const PerBeam<Echo>& echoes) {
        std::vector<NoiseRow> rows;
        for (std::size_t beam = 0; beam < echoes.beams(); ++beam) {
            const std::size_t count = std::min(echoes[beam].size(), most_echoes_read);
            while (rows.size() < count)
                rows.emplace_back(echoes.beams(), static_cast<std::uint32_t>(rows.size()));
            for (std::size_t i = 0; i < count; ++i) {
                const Echo& echo = echoes[beam][i];
                rows[i].set(beam, echo.range_m, static_cast<float>(deviation_.of_m(echo)),
                            echo.object);
            }
        }
        for (NoiseRow& row : rows)
            draw(row);
        return rows;
    }
    void draw(NoiseRow& row) const { row.draw(spec_.smoothing, spec_.beam_rad(), noise_); }

    /// All errors of all echoes of a beam that the sensor notices; or one reading that tells why
    /// there are none. Good until the next call.
    [[nodiscard]] std::span<const Reading> read_all(std::span<const Echo> echoes,
                                                    std::span<const NoiseRow> noise,
                                                    std::uint32_t beam) {
        if (loses(beam)) return only(Cause::lost);
        if (echoes.empty()) return only(Cause::nothing);
        if (contradict(echoes)) return only(Cause::edge);
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < echoes.size() && i < noise.size(); ++i) {
            const std::uint32_t chance = beam + i * beams_apart;
            const float signal = signal_of(spec_.receiver, echoes[i].range_m, echoes[i].power);
            if (!notices(signal, chance)) continue;
            read_lit(echoes[i], signal, noise[i].noise_m(beam), chance, read_[count++]);
        }
        if (count == 0) return only(Cause::too_dark);
        return std::span(read_).first(count);
    }

  private:
    [[nodiscard]] bool loses(std::uint32_t beam) const {
        return spec_.lost_share > 0.0 && 0.5 * (1.0 + losing_.even(beam)) < spec_.lost_share;
    }

    void lose_some(std::span<Reading> readings) const {
        if (spec_.lost_share <= 0.0) return;
        for (std::uint32_t beam = 0; beam < readings.size(); ++beam)
            if (readings[beam].cause == Cause::measured && loses(beam))
                readings[beam] = {.cause = Cause::lost};
    }

    [[nodiscard]] double biased_m(double range_m) { return range_m + bias_.at(range_m); }

    std::span<const Reading> only(Cause cause) {
        read_.front() = {.cause = cause};
        return std::span(read_).first(1);
    }

    [[nodiscard]] bool contradict(std::span<const Echo> echoes) const {
        if (spec_.receiver.edge_share <= 0.0 || echoes.size() < 2) return false;
        std::array<float, 2> most{};
        for (const Echo& echo : echoes) {
            const float signal = signal_of(spec_.receiver, echo.range_m, echo.power);
            if (signal > most[0])
                most = {signal, most[0]};
            else
                most[1] = std::max(most[1], signal);
        }
        return most[1] > static_cast<float>(spec_.receiver.edge_share) * most[0];
    }

    [[nodiscard]] bool notices(float signal, std::uint32_t chance) const {
        if (signal > 2.0F * weakest_) return true;  // all but never in doubt
        if (signal < 0.5F * weakest_) return false;
        return std::log(double{signal} / weakest_) +
                   noticing_spread * noticing_.standard_normal(chance) >
               0.0;
    }

    void read_lit(const Echo& echo, float signal, double noise_m, std::uint32_t chance,
                  Reading& reading) {
        const Receiver& receiver = spec_.receiver;
        reading = {.signal = signal, .intensity = intensity_read(echo, chance)};
        if (receiver.blinding_signal > 0.0 && double{signal} > receiver.blinding_signal) {
            reading.cause = Cause::too_bright;
            return;
        }
        const double error_m =
            steady_error_m(spec_, echo.range_m, bias_.at(echo.range_m), {echo.power, signal});
        reading.range_m = last_errors_.told_m(echo.range_m + error_m + noise_m);
        reading.cause = Cause::measured;
    }

    [[nodiscard]] float intensity_read(const Echo& echo, std::uint32_t chance) {
        const double told = intensity_.at(echo.range_m) * spec_.receiver.brightness(echo.power);
        const double flicker =
            spec_.receiver.intensity_noise.empty()
                ? 0.0
                : noise_factor_ * intensity_noise_.at(told) * flicker_.standard_normal(chance);
        return intensity_of(told * std::max(0.0, 1.0 + flicker));
    }

    [[nodiscard]] float intensity_of(double told) const {
        return static_cast<float>(std::min(told, spec_.receiver.most_intensity));
    }

    const SensorSpec& spec_;
    Curve::Cursor bias_;
    Deviation deviation_;
    Curve::Cursor intensity_;
    Curve::Cursor intensity_noise_;
    double noise_factor_;
    LastErrors last_errors_;
    float weakest_;
    Chance noise_;
    Chance noticing_;
    Chance losing_;
    Chance flicker_;
    std::array<Reading, most_echoes_read> read_{};
};

/// The one that a sensor with single echoes tells; `readings` is not empty, and near to far.
const Reading& chosen(std::span<const Reading> readings, EchoChoice choice) {
    if (choice == EchoChoice::first) return readings.front();
    if (choice == EchoChoice::last) return readings.back();
    return *std::ranges::max_element(readings, {}, &Reading::signal);
}

void read_ideal_hits(Reader& reader, Scan& scan) {
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam)
        reader.read_ideal(scan.middle(beam), scan.readings[beam]);
}

void read_hits(Reader& reader, Scan& scan) {
    NoiseRow noise(scan.beams(), 0);
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam) {
        const Hit& hit = scan.middle(beam);
        reader.read_ideal(hit, scan.readings[beam]);
        if (hit.met())
            noise.set(beam, hit.range_m, static_cast<float>(reader.sigma_m(hit)), hit.object);
    }
    reader.draw(noise);
    reader.add_errors(scan.readings, noise.noise_m());
}

void read_echoes(Reader& reader, const ErrorModel& model, Scan& scan) {
    scan.readings = Recycled<Reading>::take(scan.beams());
    const std::vector<NoiseRow> noise = reader.noise_of(scan.echoes);
    for (std::uint32_t beam = 0; beam < scan.beams(); ++beam) {
        const auto readings = reader.read_all(scan.echoes[beam], noise, beam);
        scan.readings[beam] = chosen(readings, model.choice);
        if (!model.tells_every_echo) continue;
        const std::size_t told = std::min(readings.size(), ErrorModel::most_echoes_told);
        for (const Reading& reading : readings.first(told))
            scan.every_echo.add(reading);
        scan.every_echo.finish_beam();
    }
}

}  // namespace

void ErrorModel::read(const SensorSpec& spec, const SpecCurves& curves, Time on_for,
                      Scan& scan) const {
    Reader reader(spec, curves, *this, on_for, scan.revolution);
    if (!scan.echoes.empty()) {
        read_echoes(reader, *this, scan);
    } else {
        scan.readings = Recycled<Reading>::take(scan.beams());
        accuracy == Accuracy::ideal ? read_ideal_hits(reader, scan) : read_hits(reader, scan);
    }
    if (codes_vary && accuracy != Accuracy::ideal)
        draw_code_chances(key(scan.revolution), scan.readings);
    for (const std::uint32_t beam : scan.dazzled)
        scan.readings[beam] = {.cause = Cause::interference};
}

Reading ErrorModel::read(const SensorSpec& spec, Time on_for, std::int64_t revolution,
                         const Hit& hit, std::uint32_t beam) const {
    const SpecCurves curves(spec);
    Reader reader(spec, curves, *this, on_for, revolution);
    Reading reading;
    reader.read_ideal(hit, reading);
    if (accuracy == Accuracy::ideal || !hit.met()) return reading;
    reader.add_errors(reading, beam, reader.sigma_m(hit) * reader.noise().standard_normal(beam));
    return reading;
}

}  // namespace scipd::sim
