// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// None, one or several things for each beam, side by side in one array. They are added beam after
// beam. A value; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scipd::sim {

template <class Thing>
class PerBeam {
  public:
    void reserve(std::size_t beams) {
        things_.reserve(beams);
        ends_.reserve(beams);
    }
    /// One more of the beam that is not finished yet.
    void add(const Thing& thing) { things_.push_back(thing); }
    Thing& add() { return things_.emplace_back(); }
    void finish_beam() { ends_.push_back(static_cast<std::uint32_t>(things_.size())); }

    /// The beams that are finished.
    [[nodiscard]] std::size_t beams() const { return ends_.size(); }
    [[nodiscard]] bool empty() const { return ends_.empty(); }
    [[nodiscard]] std::span<const Thing> operator[](std::size_t beam) const {
        const std::size_t begin = beam == 0 ? 0 : ends_[beam - 1];
        return std::span(things_).subspan(begin, ends_[beam] - begin);
    }
    /// Those of all beams.
    [[nodiscard]] std::span<const Thing> all() const { return things_; }

  private:
    std::vector<Thing> things_;
    std::vector<std::uint32_t> ends_;  ///< behind the last of each beam
};

}  // namespace scipd::sim
