// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was true of a scan, as the scipd knows that sent it. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/scipcat/top_view.h"

namespace scipd::tools {

struct Truth {
    struct Echo {
        double range_m = 0.0;
        std::string material;  ///< empty: something in the air
    };
    struct Step {
        std::optional<double> true_m;  ///< nothing: the beam met nothing
        std::string material;          ///< of what its middle met
        std::vector<Echo> echoes;      ///< empty: none came back, or the scipd knows none
    };
    std::string seed;  ///< of all that the scanner does by chance
    int first_step = 0;
    std::vector<Step> steps;
    std::vector<std::string> materials;  ///< of the world, in its order
};

/// Which scipd knows the truth, and by which name of the scanner.
struct TruthOptions {
    std::string control;
    std::string sensor;  ///< empty: the one that the target is

    void add_to(CLI::App& command);
    /// Where the user has named none, it is the one that scipctl would speak to. To be called once
    /// the options are read. Throws WrongInput where that leaves it open.
    void find_scipd();

  private:
    const CLI::Option* named_ = nullptr;
};

/// To be called before the scan is taken: from then on the scipd keeps scans to be asked for.
/// Throws as ask_truth() does.
void announce_question(const TruthOptions& options, const std::string& target);

/// The truth of the scan with this stamp, of the scanner at `target`, as the user wrote it. Throws
/// ControlError, and std::runtime_error with a sentence.
[[nodiscard]] Truth ask_truth(const TruthOptions& options, const std::string& target,
                              std::uint32_t stamp_ms);

/// Tells each point its material and error, and the view which materials there are.
void add_truth(TopView& view, const Truth& truth);

}  // namespace scipd::tools
