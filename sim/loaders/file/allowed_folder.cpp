// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/allowed_folder.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace scipd::sim {

namespace fs = std::filesystem;

namespace {

/// Set by the single thread of a confined child.
std::optional<Folders> held_to;

}  // namespace

bool lies_in_one_of(const Folders& folders, const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    if (error) return false;
    return std::ranges::any_of(folders, [&](const fs::path& folder) {
        std::error_code missing;
        const fs::path real_folder = fs::canonical(folder, missing);
        return !missing && std::ranges::mismatch(real_folder, real).in1 == real_folder.end();
    });
}

void read_only_from(Folders folders) {
    held_to = std::move(folders);
}

const Folders* folders_to_read() {
    return held_to ? &*held_to : nullptr;
}

std::string or_in_no_folder() {
    return held_to ? ", or it " + std::string(lies_in_no_folder) : "";
}

Expected<> check_allowed(const fs::path& file) {
    if (!held_to || lies_in_one_of(*held_to, file)) return {};
    return refuse(lies_in_no_folder);
}

}  // namespace scipd::sim
