// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How many times as fast as the wall's clock a scipd of our own goes in lockstep, with one thread
// and with more. What it reads is read on a thread of its own.
#pragma once

#include <chrono>
#include <iosfwd>
#include <vector>

#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {

struct LockstepQuestion {
    CapacitySetup setup;  ///< `duration` is that of the world
    int scanners = 50;
    std::vector<int> threads{1, 2};  ///< of scipd, to be compared
    int rounds = 5;                  ///< each measures all of these, one after the other
};

/// What one number of threads does.
struct LockstepSpeed {
    int threads = 1;
    std::vector<double> times_real;  ///< by round
};

/// Every scanner is read, and every byte is checked. Throws std::runtime_error where scipd does not
/// start or a stream is not whole, sim::LoadError where the world cannot be read.
std::vector<LockstepSpeed> measure_lockstep(const LockstepQuestion& question);

void print_lockstep(const LockstepQuestion& question, const std::vector<LockstepSpeed>& speeds,
                    std::ostream& out);
void write_lockstep_json(const LockstepQuestion& question, const std::vector<LockstepSpeed>& speeds,
                         std::ostream& out);

}  // namespace scipd::tools
