// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/echo_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/random.h"
#include "sim/world/medium.h"

namespace scipd::sim {
namespace {

/// The way of one beam through the media of a world: how much light is left of it, and what drops
/// or flakes it meets.
class AirPath {
  public:
    /// A beam in W that begins there.
    AirPath(std::span<const Medium> media, const glm::dvec3& from_m, const glm::dvec3& direction);

    /// The share of light left after the range and back: Beer and Lambert's law, both ways.
    [[nodiscard]] double left(double range_m) const;

    struct Drop {
        double range_m;
        double brightness;
    };
    /// The first drop or flake of each medium that the beam meets nearer than `range_m`. Drops are
    /// spread at random, so the way to the first one is exponentially distributed.
    [[nodiscard]] std::vector<Drop> drops(double range_m, const Chance& chance,
                                          std::uint32_t beam) const;

  private:
    struct Stretch {
        const Medium* medium;
        std::uint32_t index;  ///< of the medium
        double from_m;        ///< from the beam's beginning
        double to_m;
    };
    std::vector<Stretch> stretches_;
};

/// Keeps the random numbers of several media apart.
constexpr std::uint32_t media_apart = 1U << 20U;

/// The part of the beam within the box, from and to; from > to: none.
std::pair<double, double> within(const Medium& medium, const glm::dvec3& from_m,
                                 const glm::dvec3& direction) {
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = medium.low_m[axis] - from_m[axis];
        const double high = medium.high_m[axis] - from_m[axis];
        if (direction[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return {1.0, 0.0};
            continue;
        }
        const auto [near, far] = std::minmax({low / direction[axis], high / direction[axis]});
        enters = std::max(enters, near);
        leaves = std::min(leaves, far);
    }
    return {enters, leaves};
}

AirPath::AirPath(std::span<const Medium> media, const glm::dvec3& from_m,
                 const glm::dvec3& direction) {
    for (std::uint32_t i = 0; i < media.size(); ++i) {
        const auto [enters, leaves] = within(media[i], from_m, direction);
        if (enters < leaves) stretches_.push_back({&media[i], i, enters, leaves});
    }
}

double AirPath::left(double range_m) const {
    double exponent = 0.0;
    for (const Stretch& stretch : stretches_) {
        const double gone_m = std::min(range_m, stretch.to_m) - stretch.from_m;
        exponent += stretch.medium->extinction_per_m * std::max(0.0, gone_m);
    }
    return std::exp(-2.0 * exponent);
}

std::vector<AirPath::Drop> AirPath::drops(double range_m, const Chance& chance,
                                          std::uint32_t beam) const {
    std::vector<Drop> met;
    for (const Stretch& stretch : stretches_) {
        if (stretch.medium->returns_per_m <= 0.0) continue;
        const double even = 0.5 * (1.0 + chance.even(beam + stretch.index * media_apart));
        const double at_m = stretch.from_m - std::log(even) / stretch.medium->returns_per_m;
        if (at_m < std::min(range_m, stretch.to_m))
            met.push_back({at_m, stretch.medium->brightness});
    }
    return met;
}

/// A number for each cube of a centimetre in W: the hash of Teschner et al. (Optimized spatial
/// hashing for collision detection of deformable objects, 2003).
std::uint32_t cube_at(const glm::dvec3& at_m) {
    constexpr double cubes_per_m = 100.0;
    // Faces mostly lie at round numbers. There rounding would decide which cube a place is in, if
    // the cubes began there too.
    constexpr double begin_m = 0.0027182818;
    const auto along = [&](int axis) {
        return static_cast<std::uint32_t>(
            std::llround(std::floor((at_m[axis] - begin_m) * cubes_per_m)));
    };
    return (along(0) * 73856093U) ^ (along(1) * 19349663U) ^ (along(2) * 83492791U);
}

/// What one face or drop sends back to one beam.
struct Return {
    float range_m;
    float power;
    ObjectId object;
    MaterialId material;
};

/// Some returns that are one echo; `returns` is not empty. It fills the echo in place: one that is
/// copied right after its members were written makes the processor wait.
void fill_echo(std::span<const Return> returns, Echo& echo) {
    const float from_m = returns.front().range_m;
    double power = 0.0;
    double mean = 0.0;
    double square = 0.0;
    const Return* strongest = returns.data();
    for (const Return& one : returns) {
        const double beyond_m = double{one.range_m} - double{from_m};
        power += one.power;
        mean += one.power * beyond_m;
        square += one.power * beyond_m * beyond_m;
        if (one.power > strongest->power) strongest = &one;
    }
    mean /= power;
    const double variance_m2 = std::max(0.0, square / power - mean * mean);
    echo.range_m = static_cast<float>(from_m + mean);
    echo.power = static_cast<float>(power);
    echo.spread_m = static_cast<float>(std::sqrt(variance_m2));
    echo.object = strongest->object;
    echo.material = strongest->material;
}

/// Adds an echo for each run of returns in which none is farther than half a pulse behind the one
/// before it. Reorders the returns.
void add_echoes(std::vector<Return>& returns, float half_pulse_m, PerBeam<Echo>& echoes) {
    if (returns.empty()) return;
    float nearest_m = returns.front().range_m;
    float farthest_m = nearest_m;
    for (const Return& one : returns) {
        nearest_m = std::min(nearest_m, one.range_m);
        farthest_m = std::max(farthest_m, one.range_m);
    }
    if (farthest_m - nearest_m <= half_pulse_m) return fill_echo(returns, echoes.add());
    std::ranges::sort(returns, {}, &Return::range_m);
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= returns.size(); ++i) {
        const bool apart =
            i == returns.size() || returns[i].range_m - returns[i - 1].range_m > half_pulse_m;
        if (!apart) continue;
        fill_echo(std::span(returns).subspan(begin, i - begin), echoes.add());
        begin = i;
    }
}

class EchoFinder {
  public:
    EchoFinder(Scan& scan, const SensorSpec& spec, const BeamPattern& pattern, const LitWorld& lit,
               ChanceKey key)
        : scan_(scan),
          half_pulse_m_(static_cast<float>(spec.receiver.half_pulse_m)),
          beam_blur_rad2_(spec.footprint.half_width_rad * spec.footprint.half_height_rad),
          aperture_m_(spec.receiver.aperture_m),
          crosstalk_(static_cast<float>(spec.receiver.crosstalk)),
          pattern_(pattern),
          lit_(lit),
          air_chance_(for_air(key, scan.revolution)),
          texture_chance_(for_texture(key)) {}

    void find() {
        scan_.echoes.reserve(scan_.beams());
        for (std::size_t beam = 0; beam < scan_.beams(); ++beam) {
            returns_.clear();
            axis_.clear();
            add_hits(beam);
            add_farther_hits(beam);
            if (!lit_.media().empty()) pass_air(beam);
            add_echoes(returns_, half_pulse_m_, scan_.echoes);
            scan_.echoes.finish_beam();
        }
        if (crosstalk_ > 0.0F) mix_neighbours();
    }

  private:
    static Chance for_air(ChanceKey key, std::int64_t revolution) {
        key.scan = static_cast<std::uint64_t>(revolution);
        key.purpose = Purpose::in_the_air;
        return Chance(key);
    }
    /// Equal for all sensors and scans: a texture belongs to its face.
    static Chance for_texture(const ChanceKey& key) {
        return Chance({.seed = key.seed, .purpose = Purpose::texture});
    }

    void add_hits(std::size_t beam) {
        const std::span<const FootprintRay> rays = pattern_.footprint();
        const std::size_t first = beam * rays.size();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Hit& hit = scan_.hits[first + i];
            if (!hit.met()) continue;
            const Reflection& material = lit_.of(hit.material);
            float power = rays[i].weight * material.returned(hit.cos_incidence);
            if (material.surface().texture > 0.0F)
                power *= texture_at(material, place_of(beam, first + i, hit));
            if (material.smooth()) power += rays[i].weight * highlight(material, hit, i == 0);
            add(hit, power);
        }
    }

    void add_farther_hits(std::size_t beam) {
        const std::size_t end = (beam + 1) * pattern_.rays_per_beam();
        for (; farther_ < scan_.farther.size() && scan_.farther[farther_].ray < end; ++farther_) {
            const auto& [ray, share, hit, at_m] = scan_.farther[farther_];
            const FootprintRay& of = pattern_.footprint()[ray % pattern_.rays_per_beam()];
            const Reflection& material = lit_.of(hit.material);
            float power = of.weight * share * material.returned(hit.cos_incidence);
            if (material.surface().texture > 0.0F) power *= texture_at(material, at_m);
            const bool on_axis = ray % pattern_.rays_per_beam() == 0;
            if (material.smooth()) power += of.weight * share * highlight(material, hit, on_axis);
            add(hit, power);
        }
    }

    /// What comes back from a smooth face is the light that left along its normal. So the beam as a
    /// whole decides how much that is, and not where its few rays point: its width blurs what its
    /// axis meets. So does the lens, to which the light goes as far again as it went to the face.
    float highlight(const Reflection& material, const Hit& hit, bool on_axis) {
        if (on_axis) axis_.push_back(hit);
        const auto same = std::ranges::find_if(axis_, [&](const Hit& met) {
            return met.object == hit.object && met.material == hit.material;
        });
        const float cos_incidence = same == axis_.end() ? hit.cos_incidence : same->cos_incidence;
        const double lens_rad = 0.5 * aperture_m_ / std::max(1e-3, double{hit.range_m});
        return material.highlight(cos_incidence, beam_blur_rad2_ + lens_rad * lens_rad);
    }

    void add(const Hit& hit, float power) {
        if (power > 0.0F) returns_.emplace_back(hit.range_m, power, hit.object, hit.material);
    }

    [[nodiscard]] const Pose& pose_of(std::size_t beam) const {
        return scan_.world_from_sensor[scan_.world_from_sensor.size() == 1 ? 0 : beam];
    }

    [[nodiscard]] glm::dvec3 place_of(std::size_t beam, std::size_t ray, const Hit& hit) const {
        return pose_of(beam) * (double{hit.range_m} * glm::dvec3{pattern_.directions()[ray]});
    }

    [[nodiscard]] float texture_at(const Reflection& material, const glm::dvec3& at_m) const {
        const double factor =
            1.0 + material.surface().texture * texture_chance_.standard_normal(cube_at(at_m));
        return static_cast<float>(std::max(0.0, factor));
    }

    void pass_air(std::size_t beam) {
        const Pose& pose = pose_of(beam);
        const glm::dvec3 direction{pattern_.directions()[beam * pattern_.rays_per_beam()]};
        const AirPath path(lit_.media(), pose.translation_m, pose.rotation * direction);
        float nearest_m = std::numeric_limits<float>::infinity();
        for (Return& one : returns_) {
            one.power *= static_cast<float>(path.left(one.range_m));
            nearest_m = std::min(nearest_m, one.range_m);
        }
        for (const auto& [range_m, brightness] :
             path.drops(nearest_m, air_chance_, static_cast<std::uint32_t>(beam))) {
            const double power = brightness * path.left(range_m);
            returns_.push_back(
                {static_cast<float>(range_m), static_cast<float>(power), no_object, 0});
        }
        // Light of which nothing is left makes no echo, whose range would be a mean without weight.
        std::erase_if(returns_, [](const Return& one) { return one.power <= 0.0F; });
    }

    /// Each beam gets a share of the light of the beams beside it.
    void mix_neighbours() {
        PerBeam<Echo> mixed;
        mixed.reserve(scan_.beams());
        for (std::size_t beam = 0; beam < scan_.beams(); ++beam) {
            returns_.clear();
            if (beam > 0) add_echoes_of(beam - 1, crosstalk_);
            add_echoes_of(beam, 1.0F);
            if (beam + 1 < scan_.beams()) add_echoes_of(beam + 1, crosstalk_);
            add_echoes(returns_, half_pulse_m_, mixed);
            mixed.finish_beam();
        }
        scan_.echoes = std::move(mixed);
    }

    void add_echoes_of(std::size_t beam, float share) {
        for (const Echo& echo : scan_.echoes[beam])
            returns_.push_back({echo.range_m, share * echo.power, echo.object, echo.material});
    }

    Scan& scan_;
    float half_pulse_m_;
    double beam_blur_rad2_;
    double aperture_m_;
    float crosstalk_;
    const BeamPattern& pattern_;
    const LitWorld& lit_;
    Chance air_chance_;
    Chance texture_chance_;
    std::size_t farther_ = 0;  ///< the next to be added
    std::vector<Return> returns_;
    std::vector<Hit> axis_;  ///< what the axis of this beam meets that is smooth, on its whole way
};

}  // namespace

void find_echoes(Scan& scan, const SensorSpec& spec, const BeamPattern& pattern,
                 const LitWorld& lit, ChanceKey key) {
    EchoFinder(scan, spec, pattern, lit, key).find();
}

}  // namespace scipd::sim
