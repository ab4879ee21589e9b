// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The movable models of a world in a row, for sweeps: which of them move, and which of these are
// near. Views the models; whoever owns them keeps them where they are. The thread of its world.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "daemon/world/movable_model.h"
#include "daemon/world/whereabouts.h"
#include "sim/world/mover.h"

namespace scipd::daemon {

class Movers {
  public:
    using Models = std::map<std::string, MovableModel, std::less<>>;

    /// These are the models from now on.
    void view(Models& models);
    /// A pose has come for the model, which was where it was before until `left`.
    void goes_to(const MovableModel& model, const sim::Pose& pose, sim::Time left) {
        whereabouts_[model.place].goes_to(pose.translation_m, left, goes_on_m(model));
    }
    /// It moves by poses now, and by its script before.
    void leaves_script(const MovableModel& model);

    /// Nothing can move.
    [[nodiscard]] bool empty() const { return models_.empty(); }
    /// How all but `except` move between these times. Good until the next call.
    [[nodiscard]] std::vector<sim::Mover> all(sim::Time from, sim::Time to,
                                              sim::ModelId except) const;
    /// How those move of which something is in the ball then. Good until the next call.
    [[nodiscard]] std::vector<sim::Mover> within(const Ball& ball, sim::Time from, sim::Time to,
                                                 sim::ModelId except) const;

  private:
    /// Distance that it goes after its last pose, m.
    [[nodiscard]] static double goes_on_m(const MovableModel& model);

    std::vector<MovableModel*> models_;
    std::vector<Whereabouts> whereabouts_;  ///< side by side, since each sweep looks at all
};

}  // namespace scipd::daemon
