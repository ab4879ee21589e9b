// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The path length of a model: how far its points have gone at most, from the first leg on. Time is
// counted in beams of a sweep and fractions of them. A value.
#pragma once

#include <vector>

namespace scipd::sim {

class PathLength {
  public:
    /// One more leg, after those that were added before.
    void add(double from_beam, double to_beam, double length_m) {
        const double gone_m = marks_.empty() ? 0.0 : marks_.back().gone_m;
        marks_.push_back({from_beam, gone_m});
        marks_.push_back({to_beam, gone_m + length_m});
    }
    [[nodiscard]] double gone_m(double beam) const;
    /// The last moment at which it has gone no farther than this.
    [[nodiscard]] double beam_at(double gone_m) const;

  private:
    struct Mark {
        double beam = 0.0;
        double gone_m = 0.0;
    };
    std::vector<Mark> marks_;  ///< both grow or stay; between two marks the model moves evenly
};

}  // namespace scipd::sim
