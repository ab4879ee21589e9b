// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/find_program.h"

#include <array>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

#include <unistd.h>

#include "testing/scipd_values.h"

namespace scipd::testing {
namespace {

using std::filesystem::path;

// What a user would most likely mean comes first.
constexpr std::array presets{"release", "ci", "dev"};

bool can_run(const path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

/// As a shell finds it; empty if it does not.
path which(const path& name) {
    if (name.has_parent_path()) return can_run(name) ? absolute(name) : path();
    const char* const folders = std::getenv("PATH");
    std::istringstream list(folders == nullptr ? "" : folders);
    for (std::string folder; std::getline(list, folder, ':');) {
        const path file = path(folder.empty() ? "." : folder) / name;
        if (can_run(file)) return absolute(file);
    }
    return {};
}

/// In a build folder of the sources, programs lie side by side.
path beside_this_program() {
    std::error_code error;
    path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    if (can_run(folder / "scipd")) return folder / "scipd";
    for (; folder.has_relative_path(); folder = folder.parent_path()) {
        for (const char* const preset : presets) {
            const path built = folder / "build" / preset / "bin" / "scipd";
            if (can_run(built)) return built;
        }
    }
    return {};
}

}  // namespace

path find_program() {
    const char* const named = std::getenv("SCIPD");
    if (named != nullptr && *named != '\0') {
        if (path found = which(named); !found.empty()) return found;
        throw ScipdNotFound("SCIPD names " + std::string(named) +
                            ", which is no program that can be run");
    }
    if (path found = which("scipd"); !found.empty()) return found;
    if (path found = beside_this_program(); !found.empty()) return found;
    throw ScipdNotFound(
        "there is no program scipd: install the package scipd, put scipd on the "
        "PATH, or let the environment variable SCIPD name it");
}

}  // namespace scipd::testing
