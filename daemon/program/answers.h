// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd answers of itself where there is nothing to run. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "daemon/config/config.h"
#include "sim/export/map_values.h"

namespace CLI {
class App;
}

namespace scipd::daemon {

/// The end of the program: --help, --version, the lists, a checked configuration, wrong options.
struct Answer {
    /// 2: the text is for standard error, else for standard output; 1: a question answered with no.
    int exit_code = 0;
    std::string text;  ///< with its last line end
};

/// Tables with a row for each product and firmware, and a line for each way to cast.
Answer model_list();
Answer backend_list();
/// What the shell has to read so that it completes the options of `app`.
Answer completion_script(const CLI::App& app, const std::string& shell);
/// Whether this machine has what the backends need. The text tells it either way; the exit code is
/// for scripts.
Answer probe();

/// `scipd --map`: a ROS map of the world that would be scanned, without scanning it.
struct MapRequest {
    std::filesystem::path file;  ///< empty: nobody asks for a map
    std::optional<sim::HeightBand> heights;
    std::optional<double> resolution_m;
};

/// Writes the map of the configuration's world at load, without the bodies of its robots; what can
/// be reached from where they start is free. Throws LoadError.
Answer write_map(const Config& config, const MapRequest& request);

}  // namespace scipd::daemon
