// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/leftovers.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

#include <signal.h>

#include "daemon/link/path_hold.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// 4711 in "control-4711.sock" and "robot-scanner-4711". 0: the name has none.
pid_t process_in(std::string_view name) {
    if (name.ends_with(".sock")) name.remove_suffix(5);
    const std::string_view digits = name.substr(name.find_last_of('-') + 1);
    pid_t process = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), process);
    const bool whole = end == digits.data() + digits.size() && digits.size() < name.size();
    return whole && error == std::errc{} ? process : 0;
}

bool is_gone(pid_t process) {
    return process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
}

/// NAME in the lock .NAME.lock.
std::string_view name_in(std::string_view lock) {
    if (!lock.starts_with('.') || !lock.ends_with(".lock")) return {};
    return lock.substr(1, lock.size() - 6);
}

void remove(const fs::path& path) {
    std::error_code ignored;
    try {
        const PathHold hold(path);  // which removes its lock at the end
        const auto type = fs::symlink_status(path, ignored).type();
        if (type == fs::file_type::symlink || type == fs::file_type::socket)
            fs::remove(path, ignored);
    } catch (const std::exception&) {
        // Somebody has it after all, or it is not ours to remove.
    }
}

}  // namespace

void remove_leftovers(const fs::path& run_directory) {
    std::vector<fs::path> left;
    std::error_code error;
    for (fs::directory_iterator at{run_directory, error}, end; !error && at != end;
         at.increment(error)) {
        const std::string lock = at->path().filename();
        const std::string_view name = name_in(lock);
        if (is_gone(process_in(name))) left.push_back(run_directory / name);
    }
    std::ranges::for_each(left, remove);
}

}  // namespace scipd::daemon
