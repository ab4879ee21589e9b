// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/noise_row.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "sim/recycled.h"

namespace scipd::sim {
namespace {

/// So that the returns of one beam do not share their chance, nor the margins with any.
constexpr std::uint32_t chances_apart = 1U << 20U;
constexpr std::uint32_t first_margin = 8;  ///< more ranks than this are not drawn
constexpr std::uint32_t margins_of_a_face = 4;

constexpr float none_m = std::numeric_limits<float>::infinity();

/// From one beam to the next a face changes its range by less than so many beams' widths: it is
/// seen at less than 84 degrees.
constexpr float steepest = 10.0F;
/// Nor does that change differ by more than this from the change before it. At a corner of 90
/// degrees the two differ by two widths, or by one each where it lies in the middle of two beams.
constexpr float most_bent = 0.7F;

/// The standard deviation of the median of five numbers whose own is 1.
constexpr float deviation_of_median = 0.53557F;

/// Why a face may end between two beams: none, one or both.
enum End : std::uint8_t { none = 0, bend = 1, tear = 2 };

float median(float a, float b, float c, float d, float e) {
    const float low = std::max(std::min(a, b), std::min(c, d));
    const float high = std::min(std::max(a, b), std::max(c, d));
    return std::max(std::min(low, high), std::min(std::max(low, high), e));
}

/// A beam's own chance and shares of its neighbours', so weighed that their deviation is 1.
struct Mix {
    Mix(const Smoothing& smoothing, std::span<const float> sigma_m)
        : next(static_cast<float>(smoothing.next)),
          after(static_cast<float>(smoothing.after_next)),
          own(1.0F / std::sqrt(1.0F + 2.0F * (next * next + after * after))),
          sigma_m(sigma_m) {}

    /// `z` points at the beam's own chance.
    [[nodiscard]] float noise_m(const float* z, std::size_t beam) const {
        return sigma_m[beam] * own * (z[0] + next * (z[-1] + z[1]) + after * (z[-2] + z[2]));
    }
    [[nodiscard]] static float drawn(std::size_t, std::size_t, float z) { return z; }
    [[nodiscard]] float noise_alone_m(float z, std::size_t beam) const { return sigma_m[beam] * z; }

    float next;
    float after;
    float own;
    std::span<const float> sigma_m;
};

/// The median of what the beams would read. On a slope it chooses less, so it leaves more noise
/// there, as in the recordings.
struct Median {
    [[nodiscard]] float noise_m(const float* read_m, std::size_t beam) const {
        return median(read_m[-2], read_m[-1], read_m[0], read_m[1], read_m[2]) - range_m[beam];
    }
    /// What it would read as far before `beam` as `mirrored` is behind it, on a face that goes on.
    [[nodiscard]] float drawn(std::size_t beam, std::size_t mirrored, float z) const {
        return 2.0F * range_m[beam] - range_m[mirrored] + sigma_m[beam] / deviation_of_median * z;
    }

    [[nodiscard]] float noise_alone_m(float read_m, std::size_t beam) const {
        return deviation_of_median * (read_m - range_m[beam]);
    }

    std::span<const float> range_m;
    std::span<const float> sigma_m;
};

}  // namespace

NoiseRow::NoiseRow(std::size_t beams, std::uint32_t rank)
    : rank_(rank),
      range_m_(Recycled<float>::take(beams)),
      sigma_m_(Recycled<float>::take(beams)),
      objects_(Recycled<ObjectId>::take(beams)),
      ends_(Recycled<std::uint8_t>::take(beams)),
      drawn_(Recycled<float>::take(beams)),
      noise_m_(Recycled<float>::take(beams)) {
    std::ranges::fill(range_m_, none_m);
    std::ranges::fill(objects_, no_object);
}

NoiseRow::~NoiseRow() {
    Recycled<float>::give(std::move(range_m_));
    Recycled<float>::give(std::move(sigma_m_));
    Recycled<ObjectId>::give(std::move(objects_));
    Recycled<std::uint8_t>::give(std::move(ends_));
    Recycled<float>::give(std::move(drawn_));
    Recycled<float>::give(std::move(noise_m_));
}

void NoiseRow::draw(const Smoothing& smoothing, double beam_rad, const Chance& chance) {
    chance.standard_normals(rank_ * chances_apart, drawn_);
    if (smoothing.none()) {
        std::ranges::transform(sigma_m_, drawn_, noise_m_.begin(), std::multiplies<>{});
        return;
    }
    find_ends(static_cast<float>(beam_rad));
    if (smoothing.median_of_five)
        smooth(chance, Median{range_m_, sigma_m_});
    else
        smooth(chance, Mix(smoothing, sigma_m_));
}

/// Without branches, so that the compiler takes several beams at once.
void NoiseRow::find_ends(float beam_rad) {
    const float* range_m = range_m_.data();
    const ObjectId* objects = objects_.data();
    std::uint8_t* ends = ends_.data();
    const auto end_before = [=](std::size_t beam, float rise_before_m) {
        const float width_m = beam_rad * range_m[beam - 1];
        const float rise_m = range_m[beam] - range_m[beam - 1];
        // A beam without a return is infinitely far, and all comparisons with such a rise fail.
        // Beams in a row without returns are as one face.
        const bool near = std::abs(rise_m) < steepest * width_m;
        const bool straight = std::abs(rise_m - rise_before_m) < most_bent * width_m;
        const bool same = objects[beam] == objects[beam - 1];
        const bool there = !same | (objects[beam] != no_object);
        return static_cast<std::uint8_t>(there * (tear * !(near & same) | bend * !straight));
    };
    const std::size_t beams = range_m_.size();
    if (beams > 1) ends[1] = end_before(1, 0.0F);
    for (std::size_t beam = 2; beam < beams; ++beam)
        ends[beam] = end_before(beam, range_m[beam - 1] - range_m[beam - 2]);
}

/// Looks at eight beams at once where it can: one by one they took 2 % of a revolution.
std::size_t NoiseRow::next_end(std::size_t beam) const {
    for (std::uint64_t eight = 0; beam + sizeof(eight) <= ends_.size(); beam += sizeof(eight)) {
        std::memcpy(&eight, &ends_[beam], sizeof(eight));
        if (eight != 0) break;
    }
    while (beam < ends_.size() && ends_[beam] == none)
        ++beam;
    return beam;
}

/// Two beams alone do not tell how a face rises.
NoiseRow::Face NoiseRow::face_from(std::size_t begin) const {
    const std::size_t end = next_end(begin + 1);
    const bool too_short = end == begin + 1 && end < ends_.size() && ends_[end] == bend;
    return {begin, too_short ? next_end(end + 1) : end};
}

/// As if all beams saw one face, and then anew where its ends are.
template <class Smooth>
void NoiseRow::smooth(const Chance& chance, const Smooth& smooth) {
    const std::size_t beams = drawn_.size();
    for (std::size_t beam = 0; beam < beams; ++beam)
        drawn_[beam] = smooth.drawn(beam, beam, drawn_[beam]);
    for (std::size_t beam = beyond; beam + beyond < beams; ++beam)
        noise_m_[beam] = smooth.noise_m(&drawn_[beam], beam);
    for (Face face = face_from(0); face.begin < beams; face = face_from(face.end)) {
        if (range_m_[face.begin] == none_m) continue;
        if (face.end == face.begin + 1) {
            noise_m_[face.begin] = smooth.noise_alone_m(drawn_[face.begin], face.begin);
            continue;
        }
        const std::size_t second = std::min(face.begin + beyond, face.end);
        for (std::size_t beam = face.begin; beam < second; ++beam)
            noise_m_[beam] = smooth.noise_m(&window(face, beam, chance, smooth)[beyond], beam);
        const std::size_t last = std::max(second + beyond, face.end) - beyond;
        for (std::size_t beam = last; beam < face.end; ++beam)
            noise_m_[beam] = smooth.noise_m(&window(face, beam, chance, smooth)[beyond], beam);
    }
}

template <class Smooth>
NoiseRow::Window NoiseRow::window(Face face, std::size_t beam, const Chance& chance,
                                  const Smooth& smooth) const {
    const std::size_t last = face.end - 1;
    const std::size_t length = last - face.begin;
    const std::uint32_t margins = first_margin + rank_ * margins_of_a_face;
    const auto chance_of = [&](std::size_t margin, std::size_t end) {
        const auto apart = static_cast<std::uint32_t>(margins + margin) * chances_apart;
        return static_cast<float>(chance.standard_normal(apart + static_cast<std::uint32_t>(end)));
    };
    Window window;
    for (std::size_t i = 0; i < window.size(); ++i) {
        const std::size_t place = beam + i;  // of the row, and `beyond` more
        if (place < face.begin + beyond) {
            const std::size_t apart = face.begin + beyond - place;
            const std::size_t mirrored = face.begin + std::min(apart, length);
            window[i] = smooth.drawn(face.begin, mirrored, chance_of(apart - 1, face.begin));
        } else if (place > last + beyond) {
            const std::size_t apart = place - last - beyond;
            const std::size_t mirrored = last - std::min(apart, length);
            window[i] = smooth.drawn(last, mirrored, chance_of(beyond + apart - 1, face.end));
        } else {
            window[i] = drawn_[place - beyond];
        }
    }
    return window;
}

}  // namespace scipd::sim
