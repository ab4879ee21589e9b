// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/run_directory.h"

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace scipd::daemon {

namespace {

std::string in_tmp() {
    return "/tmp/scipd-" + std::to_string(getuid());
}

}  // namespace

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
    return in_tmp();
}

std::filesystem::path usual_control_socket() {
    return run_directory() / "control.sock";
}

std::filesystem::path make_run_directory() {
    std::filesystem::path folder = run_directory();
    if (folder == in_tmp()) {
        make_private_folder(folder);
    } else {
        make_folder(folder);  // somebody's choice
    }
    return folder;
}

void make_folder(const std::filesystem::path& folder) {
    try {
        if (!folder.empty() && std::filesystem::create_directories(folder))
            std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
    } catch (const std::filesystem::filesystem_error& error) {
        throw std::runtime_error("cannot make the folder " + folder.string() + ": " +
                                 error.code().message() + "; choose another one");
    }
}

// In /tmp somebody else may have been first, with a folder or a link of his own.
void make_private_folder(const std::filesystem::path& folder) {
    if (::mkdir(folder.c_str(), S_IRWXU) == 0) return;
    struct stat status = {};
    if (::lstat(folder.c_str(), &status) != 0) {
        throw std::runtime_error("cannot make the folder " + folder.string() + ": " +
                                 std::generic_category().message(errno) +
                                 "; set XDG_RUNTIME_DIR to another one");
    }
    if (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid()) {
        throw std::runtime_error(folder.string() +
                                 " is no folder of this user; set XDG_RUNTIME_DIR to one that is");
    }
    if ((status.st_mode & ALLPERMS) != S_IRWXU) {
        throw std::runtime_error(folder.string() +
                                 " must be for this user alone; chmod 700 it, after a look at "
                                 "what is in it");
    }
}

}  // namespace scipd::daemon
