// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One step of a time that many daemons share: all poses of a moment, in one message. Its first line
// is a comment to all who read pose lines: "# step 7 t 12.5 from NAME". Values; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/time.h"

namespace scipd::daemon {

struct Step {
    int number = 0;
    sim::Time time{};  ///< the stamp that its poses have
    std::string from;  ///< who leads time
    std::string_view lines;
};

/// The first line, with its end.
std::string step_head(int number, sim::Time time, std::string_view from);
/// Nothing where the first line is another one. What this returns lives as long as the text.
std::optional<Step> parse_step(std::string_view text);

/// What a daemon says that has done a step.
std::string acknowledgement(const Step& step);
/// The number of the step, if it is one of that leader.
std::optional<int> acknowledged(std::string_view text, std::string_view leader);

}  // namespace scipd::daemon
