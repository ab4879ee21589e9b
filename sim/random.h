// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Chance as a function: the same key and beam always give the same number, whatever was drawn
// before, on whichever thread.
#pragma once

#include <cstdint>
#include <span>

namespace scipd::sim {

/// What a number is for, so that two uses with the same key do not share their chance.
enum class Purpose : std::uint32_t {
    range_noise,
    latency_to_client,
    latency_to_device,
    lost_beams,
    detection,
    texture,
    in_the_air,
    fault_begin,
    fault,
    mirror_phase,
    intensity_noise,
    unit,
    code,
};

struct ChanceKey {
    std::uint64_t seed = 0;    ///< of the whole run
    std::uint64_t sensor = 0;  ///< stable over runs: derived from the sensor's name
    std::uint64_t scan = 0;
    Purpose purpose = Purpose::range_noise;
};

/// All the numbers of one key, one for each beam. What the beams of a scan share is worked out
/// once.
class Chance {
  public:
    explicit Chance(const ChanceKey& key);

    /// A number of the normal distribution with mean 0 and standard deviation 1.
    [[nodiscard]] double standard_normal(std::uint32_t beam) const;
    /// Those of as many beams in a row, in less time.
    void standard_normals(std::uint32_t first_beam, std::span<float> numbers) const;
    /// Even between -1 and 1, never either.
    [[nodiscard]] double even(std::uint32_t beam) const;

  private:
    std::uint64_t state_;
};

}  // namespace scipd::sim
