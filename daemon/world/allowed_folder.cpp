// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/allowed_folder.h"

#include <algorithm>
#include <system_error>

namespace scipd::daemon {

namespace fs = std::filesystem;

bool lies_in_one_of(const std::vector<fs::path>& folders, const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    if (error) return false;
    return std::ranges::any_of(folders, [&](const fs::path& folder) {
        std::error_code missing;
        const fs::path real_folder = fs::canonical(folder, missing);
        return !missing && std::ranges::mismatch(real_folder, real).in1 == real_folder.end();
    });
}

}  // namespace scipd::daemon
