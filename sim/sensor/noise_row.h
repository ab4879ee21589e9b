// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The noise of one return for each beam of a scan, in which neighbours share theirs as far as they
// see the same face. It follows from the chance and from what the beams met, so it is the same for
// every number of threads and clients. Lives for the time of one scan.
//
// A face ends where the object is another one, where the range jumps, and where it bends as at a
// corner of 90 degrees. A beam beside the end of its face has neighbours beyond it that continue
// the face and that no other face knows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/random.h"
#include "sim/sensor/noise_law.h"

namespace scipd::sim {

class NoiseRow {
  public:
    /// `rank` tells the returns of one beam apart, 0 for the nearest: each has chances of its own.
    NoiseRow(std::size_t beams, std::uint32_t rank);
    ~NoiseRow();
    NoiseRow(NoiseRow&&) = default;
    NoiseRow(const NoiseRow&) = delete;
    NoiseRow& operator=(NoiseRow&&) = delete;
    NoiseRow& operator=(const NoiseRow&) = delete;

    /// A beam for which this is not called has no return.
    void set(std::size_t beam, float range_m, float sigma_m, ObjectId object) {
        range_m_[beam] = range_m;
        sigma_m_[beam] = sigma_m;
        objects_[beam] = object;
    }

    /// To be called once, when all returns are set. `beam_rad`: the angle between two beams.
    void draw(const Smoothing& smoothing, double beam_rad, const Chance& chance);

    /// The noise of a beam that has a return.
    [[nodiscard]] float noise_m(std::size_t beam) const { return noise_m_[beam]; }
    /// The noise of each beam; it is some number where the beam has no return.
    [[nodiscard]] std::span<const float> noise_m() const { return noise_m_; }

  private:
    /// So many beams on either side reach into the noise of one.
    static constexpr std::size_t beyond = 2;

    struct Face {
        std::size_t begin;  ///< the first of its beams
        std::size_t end;    ///< behind the last one
    };
    /// The beams around one, as its face goes on.
    using Window = std::array<float, 2 * beyond + 1>;

    void find_ends(float beam_rad);
    /// The first beam from `beam` on before which a face may end.
    [[nodiscard]] std::size_t next_end(std::size_t beam) const;
    [[nodiscard]] Face face_from(std::size_t begin) const;
    template <class Smooth>
    void smooth(const Chance& chance, const Smooth& smooth);
    template <class Smooth>
    [[nodiscard]] Window window(Face face, std::size_t beam, const Chance& chance,
                                const Smooth& smooth) const;

    std::uint32_t rank_;
    std::vector<float> range_m_;
    std::vector<float> sigma_m_;
    std::vector<ObjectId> objects_;
    std::vector<std::uint8_t> ends_;  ///< whether a face ends before this beam
    std::vector<float> drawn_;        ///< before a beam's neighbours are looked at
    std::vector<float> noise_m_;
};

}  // namespace scipd::sim
