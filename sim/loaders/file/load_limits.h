// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the loading of one world or model may take. A value.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <stop_token>

#include "sim/loaders/file/allowed_folder.h"

namespace scipd::sim {

struct LoadLimits {
    std::size_t memory_bytes = std::size_t{16} << 30U;
    std::chrono::seconds wall_time = std::chrono::minutes{10};
    std::stop_token stop = {};
    std::optional<Folders> folders = {};  ///< nothing is read elsewhere; without: anything is
};

}  // namespace scipd::sim
