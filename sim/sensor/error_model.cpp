// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/error_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "sim/recycled.h"
#include "sim/sensor/curve.h"

namespace scipd::sim {
namespace {

/// So that the echoes of one beam do not share their chance.
constexpr std::uint32_t beams_apart = 1U << 20U;
/// More echoes of one beam are not looked at.
constexpr std::size_t most_echoes_read = 8;

double drift_m(const WarmUp& warm_up, Time on_for) {
    if (warm_up.drift_m == 0.0) return 0.0;
    const std::chrono::duration<double> on_for_s = on_for;
    const std::chrono::duration<double> constant_s = warm_up.time_constant;
    return warm_up.drift_m * std::exp(-on_for_s / constant_s);
}

ChanceKey with_purpose(ChanceKey key, Purpose purpose) {
    key.purpose = purpose;
    return key;
}

/// Reads the echoes of one scan.
class Reader {
  public:
    Reader(const SensorSpec& spec, const ErrorModel& model, Time on_for, std::int64_t revolution)
        : spec_(spec),
          bias_(spec.bias, &BiasPoint::bias_m),
          sigma_(spec.noise),
          intensity_(spec.receiver.intensity, &IntensityPoint::intensity),
          drift_m_(drift_m(spec.warm_up, on_for)),
          weakest_(weakest_signal(spec.receiver)),
          noise_(with_purpose(model.key(revolution), Purpose::range_noise)),
          noticing_(with_purpose(model.key(revolution), Purpose::detection)),
          losing_(with_purpose(model.key(revolution), Purpose::lost_beams)) {}

    /// The reading of a hit without errors. It fills a new reading in place, member by member: a
    /// Reading that is returned is copied in pieces that the processor has to wait for, which took
    /// a tenth of a whole revolution.
    void read_ideal(const Hit& hit, Curve::Cursor& white, Reading& reading) const {
        if (!hit.met()) return;
        reading.range_m = hit.range_m;
        reading.intensity = intensity_of(white.at(hit.range_m), hit.cos_incidence);
        reading.cause = Cause::measured;
    }
    [[nodiscard]] Curve::Cursor white() const { return Curve::Cursor(intensity_); }
    [[nodiscard]] Curve::Cursor bias() const { return Curve::Cursor(bias_); }
    [[nodiscard]] Curve::Cursor sigma() const { return Curve::Cursor(sigma_); }

    /// Adds the errors that follow from the range alone. `normal`: the chance of this beam.
    void add_errors(Reading& reading, std::uint32_t beam, double normal, Curve::Cursor& bias,
                    Curve::Cursor& sigma) const {
        if (reading.cause != Cause::measured) return;
        if (loses(beam)) {
            reading = {.cause = Cause::lost};
        } else {
            const double noise_m = sigma.at(reading.range_m) * normal;
            reading.range_m = told_m(reading.range_m + bias.at(reading.range_m) + noise_m);
        }
    }
    [[nodiscard]] const Chance& noise() const { return noise_; }

    /// All errors of all echoes of a beam that the sensor notices; or one reading that tells why
    /// there are none. Good until the next call.
    [[nodiscard]] std::span<const Reading> read_all(std::span<const Echo> echoes,
                                                    std::uint32_t beam) {
        if (loses(beam)) return only(Cause::lost);
        if (echoes.empty()) return only(Cause::nothing);
        if (contradict(echoes)) return only(Cause::edge);
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < echoes.size() && count < read_.size(); ++i) {
            const std::uint32_t chance = beam + i * beams_apart;
            const float signal = signal_of(spec_.receiver, echoes[i].range_m, echoes[i].power);
            if (notices(signal, chance)) read_[count++] = read_lit(echoes[i], signal, chance);
        }
        if (count == 0) return only(Cause::too_dark);
        return std::span(read_).first(count);
    }

  private:
    [[nodiscard]] bool loses(std::uint32_t beam) const {
        return spec_.lost_share > 0.0 && 0.5 * (1.0 + losing_.even(beam)) < spec_.lost_share;
    }

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

    [[nodiscard]] Reading read_lit(const Echo& echo, float signal, std::uint32_t chance) const {
        const Receiver& receiver = spec_.receiver;
        if (receiver.blinding_signal > 0.0 && double{signal} > receiver.blinding_signal)
            return {.signal = signal,
                    .intensity = intensity_of(intensity_.at(echo.range_m), echo.power),
                    .cause = Cause::too_bright};
        const double sigma_m = sigma_.at(echo.range_m);
        const double weakness = double{weakest_} / signal;
        const double all_m =
            std::sqrt(sigma_m * sigma_m * (1.0 + weakness) + square(spread_share * echo.spread_m));
        const double walk_m =
            receiver.walk_m == 0.0 ? 0.0 : -receiver.walk_m * std::log10(double{echo.power});
        const double noise_m = all_m * noise_.standard_normal(chance);
        return {told_m(echo.range_m + bias_.at(echo.range_m) + walk_m + noise_m), signal,
                intensity_of(intensity_.at(echo.range_m), echo.power), Cause::measured};
    }

    [[nodiscard]] float intensity_of(double white, float power) const {
        return static_cast<float>(std::min(white * power, spec_.receiver.most_intensity));
    }

    /// The last errors, which all ranges have.
    [[nodiscard]] float told_m(double range_m) const {
        double read_m = range_m + drift_m_;
        if (spec_.lattice_m > 0.0) read_m = std::round(read_m / spec_.lattice_m) * spec_.lattice_m;
        return static_cast<float>(std::max(0.0, read_m));
    }

    static double square(double x) { return x * x; }

    const SensorSpec& spec_;
    Curve bias_;
    Curve sigma_;
    Curve intensity_;
    double drift_m_;
    float weakest_;
    Chance noise_;
    Chance noticing_;
    Chance losing_;
    std::array<Reading, most_echoes_read> read_{};
};

/// The one that a sensor with single echoes tells; `readings` is not empty, and near to far.
const Reading& chosen(std::span<const Reading> readings, EchoChoice choice) {
    if (choice == EchoChoice::first) return readings.front();
    if (choice == EchoChoice::last) return readings.back();
    return *std::ranges::max_element(readings, {}, &Reading::signal);
}

// One loop that makes readings and one that adds errors take less time than one for both.
void read_hits(const Reader& reader, const ErrorModel& model, Scan& scan) {
    scan.readings = Recycled<Reading>::take(scan.beams());
    std::ranges::fill(scan.readings, Reading{});
    Curve::Cursor white = reader.white();
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam)
        reader.read_ideal(scan.middle(beam), white, scan.readings[beam]);
    if (model.accuracy == Accuracy::ideal) return;
    Curve::Cursor bias = reader.bias();
    Curve::Cursor sigma = reader.sigma();
    std::array<double, 64> normals;
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam) {
        const std::size_t i = beam % normals.size();
        if (i == 0) reader.noise().standard_normals(static_cast<std::uint32_t>(beam), normals);
        reader.add_errors(scan.readings[beam], static_cast<std::uint32_t>(beam), normals[i], bias,
                          sigma);
    }
}

void read_echoes(Reader& reader, const ErrorModel& model, Scan& scan) {
    scan.readings.clear();
    scan.readings.reserve(scan.beams());
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
        const std::span<const Reading> readings =
            reader.read_all(scan.echoes[beam], static_cast<std::uint32_t>(beam));
        scan.readings.push_back(chosen(readings, model.choice));
        if (!model.tells_every_echo) continue;
        const std::size_t told = std::min(readings.size(), ErrorModel::most_echoes_told);
        for (const Reading& reading : readings.first(told))
            scan.every_echo.add(reading);
        scan.every_echo.finish_beam();
    }
}

}  // namespace

float signal_of(const Receiver& receiver, float range_m, float power) {
    const float level_m = std::max(range_m, static_cast<float>(receiver.level_below_m));
    return power / (level_m * level_m);
}

float weakest_signal(const Receiver& receiver) {
    constexpr float dark = 0.1F;
    if (receiver.dark_range_m <= 0.0) return 0.0F;
    return signal_of(receiver, static_cast<float>(receiver.dark_range_m), dark);
}

void ErrorModel::read(const SensorSpec& spec, Time on_for, Scan& scan) const {
    Reader reader(spec, *this, on_for, scan.revolution);
    if (scan.echoes.empty())
        read_hits(reader, *this, scan);
    else
        read_echoes(reader, *this, scan);
    for (const std::uint32_t beam : scan.dazzled)
        scan.readings[beam] = {.cause = Cause::interference};
}

Reading ErrorModel::read(const SensorSpec& spec, Time on_for, std::int64_t revolution,
                         const Hit& hit, std::uint32_t beam) const {
    const Reader reader(spec, *this, on_for, revolution);
    Curve::Cursor white = reader.white();
    Curve::Cursor bias = reader.bias();
    Curve::Cursor sigma = reader.sigma();
    Reading reading;
    reader.read_ideal(hit, white, reading);
    if (accuracy != Accuracy::ideal)
        reader.add_errors(reading, beam, reader.noise().standard_normal(beam), bias, sigma);
    return reading;
}

}  // namespace scipd::sim
