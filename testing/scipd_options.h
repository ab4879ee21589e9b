// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a test wants of its scipd. A value; no thread rule.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "testing/scipd_values.h"

namespace scipd::testing {

enum class ClockKind {
    wall,
    poses,  ///< lockstep: time stands still, and Clock::run() has it go on
};

struct Options {
    /// A file or folder as --scene has it; without one, the rescue maze. The scanner is 0.25 m up,
    /// unless `args` have --mount.
    std::filesystem::path world = {};
    std::string model = "UST-10LX";  ///< or such as URG-04LX@3.3.00
    /// The name of a configuration, or an object as such a file has it, for any number of robots;
    /// then model and accuracy stand there. Give its scanners port 0 (`tcp: 127.0.0.1:0`) or
    /// `pty: auto`. Paths in an object must be absolute.
    Json config = nullptr;
    std::string poses = {};  ///< as --poses has it. In lockstep these poses lead time
    ClockKind clock = ClockKind::wall;
    std::string accuracy = {};  ///< ideal, sensor or material; empty: sensor
    std::optional<std::uint64_t> seed = std::nullopt;
    /// More options of scipd, which hold in place of what would be chosen here.
    std::vector<std::string> args = {};
};

}  // namespace scipd::testing
