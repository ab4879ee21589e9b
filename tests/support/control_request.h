// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One question to a running scipd's control socket, as `curl --unix-socket` asks it.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace scipd::tests {

/// Throws std::runtime_error where the answer is not 200.
nlohmann::json control_get(const std::filesystem::path& socket, const std::string& path);

}  // namespace scipd::tests
