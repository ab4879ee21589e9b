// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/run_directory.h"

#include <cstdlib>
#include <string>
#include <string_view>

#include <unistd.h>

namespace scipd::daemon {

std::filesystem::path run_directory() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string{value ? value : ""};
    };
    if (auto ours = variable("RUNTIME_DIRECTORY"); !ours.empty()) {
        // systemd joins several with colons; the first is as good as any.
        return ours.substr(0, ours.find(':'));
    }
    if (const auto users = variable("XDG_RUNTIME_DIR"); !users.empty()) {
        return std::filesystem::path{users} / "scipd";
    }
    return "/tmp/scipd-" + std::to_string(getuid());
}

}  // namespace scipd::daemon
