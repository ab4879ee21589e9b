// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether a sensor's sweeps are cast as fast as they are fired, beside those of all other sensors
// on the same thread. One that takes longer says nothing, the machine may be busy; some seconds of
// them do. Reads no clock. One thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/time.h"

namespace scipd::daemon {

/// A sweep that was cast.
struct CastSweep {
    std::string_view backend;
    sim::Time period{};  ///< from one sweep to the next
    bool many_poses = false;
    sim::Time due{};    ///< by the same clock as the next two
    sim::Time begin{};  ///< of casting
    sim::Time end{};
};

class Pace {
  public:
    /// A sentence for people, once, when for some seconds sweeps have taken longer than they last,
    /// or a good part of it and were late: what casts, how long it takes and what would help.
    std::optional<std::string> add(const CastSweep& sweep);

  private:
    std::string backend_;
    sim::Time begin_{};  ///< of the sweeps that are looked at
    int sweeps_ = 0;     ///< so many
    sim::Time spent_{};  ///< on them
    sim::Time late_{};   ///< in sum
    bool told_ = false;
};

}  // namespace scipd::daemon
