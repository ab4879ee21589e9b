// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/scipfit/standing.h"

namespace scipd::tools {
namespace {

/// Where faces end, as sim/sensor/noise_row has it, with room for the noise of means.
class Faces {
  public:
    Faces(double beam_rad, std::vector<Beam>& beams) : beam_rad_(beam_rad), beams_(beams) {}

    void find_ends() {
        for (std::size_t beam = 1; beam < beams_.size(); ++beam)
            beams_[beam].end_before = !near(beam);
        // A corner may lie in the middle of two beams, which bend by half of it each.
        for (const std::size_t span : {1U, 2U}) {
            std::vector<std::size_t> ends;
            for (std::size_t beam = span + 1; beam < beams_.size(); ++beam) {
                if (bent(beam, span)) ends.push_back(beam);
            }
            for (const std::size_t beam : ends)
                beams_[beam].end_before = true;
        }
        find_near_corners();
    }

    void find_insides() {
        for (std::size_t beam = 2; beam + 2 < beams_.size(); ++beam) {
            bool inside = beams_[beam - 2].still;
            for (std::size_t i = beam - 1; i <= beam + 2; ++i)
                inside = inside && !beams_[i].end_before;
            beams_[beam].inside = inside;
            if (inside)
                beams_[beam].slope_mm = (beams_[beam + 2].mean_mm - beams_[beam - 2].mean_mm) / 4;
        }
    }

  private:
    /// Near by, beams lie so close together that a corner hides in their noise, unless four of them
    /// are looked at on either side. Where it is is then known to a beam.
    void find_near_corners() {
        std::vector<double> bends(beams_.size(), 0.0);
        for (std::size_t beam = side + 1; beam + side < beams_.size(); ++beam)
            bends[beam] = bend_of_sides(beam);
        for (std::size_t beam = side + 1; beam + side < beams_.size(); ++beam) {
            const auto around = bends.begin() + static_cast<std::ptrdiff_t>(beam);
            if (bends[beam] == 0.0 || bends[beam] < *std::max_element(around - 2, around + 3))
                continue;
            for (std::size_t i = beam - 1; i <= beam + 1; ++i)
                beams_[i].end_before = true;
        }
    }

    /// How much the slopes of both sides differ; 0 where that is no corner.
    [[nodiscard]] double bend_of_sides(std::size_t beam) const {
        for (std::size_t i = beam - side; i <= beam + side; ++i) {
            if (beams_[i].end_before) return 0.0;
        }
        const double behind = beams_[beam + side].mean_mm - beams_[beam].mean_mm;
        const double before = beams_[beam - 1].mean_mm - beams_[beam - 1 - side].mean_mm;
        const double bend = std::abs(behind - before) / side;
        return bend > most_bent * width_mm(beam) + room_mm(beam) / side ? bend : 0.0;
    }

    [[nodiscard]] double rise_mm(std::size_t beam) const {
        return beams_[beam].mean_mm - beams_[beam - 1].mean_mm;
    }
    [[nodiscard]] double width_mm(std::size_t beam) const {
        return beam_rad_ * beams_[beam - 1].mean_mm;
    }
    /// Real scanners read each beam a little differently, too.
    [[nodiscard]] double room_mm(std::size_t beam) const {
        constexpr double of_units_mm = 1.0;
        const double variance = beams_[beam].variance_mm2 + beams_[beam - 1].variance_mm2;
        return of_units_mm + 3.0 * std::sqrt(variance / static_cast<double>(beams_[beam].count));
    }

    [[nodiscard]] bool near(std::size_t beam) const {
        constexpr double steepest = 10.0;
        return beams_[beam].still && beams_[beam - 1].still &&
               std::abs(rise_mm(beam)) < steepest * width_mm(beam) + room_mm(beam);
    }

    /// Whether the rise differs from the one that is `span` beams before.
    [[nodiscard]] bool bent(std::size_t beam, std::size_t span) const {
        for (std::size_t i = beam - span; i <= beam; ++i) {
            if (beams_[i].end_before) return false;
        }
        return std::abs(rise_mm(beam) - rise_mm(beam - span)) >
               static_cast<double>(span) * most_bent * width_mm(beam) + room_mm(beam);
    }

    static constexpr double most_bent = 0.7;
    static constexpr std::size_t side = 4;

    double beam_rad_;
    std::vector<Beam>& beams_;
};

}  // namespace

void find_faces(double beam_rad, std::vector<Beam>& beams) {
    Faces faces(beam_rad, beams);
    faces.find_ends();
    faces.find_insides();
}

}  // namespace scipd::tools
