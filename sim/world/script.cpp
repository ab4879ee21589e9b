// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/script.h"

#include <algorithm>
#include <iterator>

namespace scipd::sim {

Pose Script::at(Time begin, Time time) const {
    return between(begin, time, time).at(time);
}

PoseTrack Script::between(Time begin, Time from, Time to) const {
    Time lap_begin = begin;
    if (lap > Time{} && from > begin) lap_begin += (from - begin) / lap * lap;
    auto step = std::ranges::upper_bound(steps, from - lap_begin, {}, &Step::time);
    if (step != steps.begin()) --step;
    PoseTrack track(step->pose);
    while (true) {
        const Time time = lap_begin + step->time;
        track.append(time, step->pose);
        if (++step == steps.end()) {
            if (lap == Time{}) return track;
            lap_begin += lap;
            step = steps.begin();
        }
        if (time > to) return track;
    }
}

SharedScript moved(const Pose& world_from_frame, const Script& script) {
    auto walk = std::make_shared<Script>(script);
    for (Script::Step& step : walk->steps)
        step.pose = world_from_frame * step.pose;
    return walk;
}

}  // namespace scipd::sim
