// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/landlock.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t to_read = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
/// What the first version of Landlock knows, but for running programs.
constexpr std::uint64_t held =
    to_read | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
    LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
    LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
    LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

/// What is not there needs no rule.
void allow(int rules, const fs::path& path, std::uint64_t access) {
    const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
    if (file < 0) return;
    struct stat status = {};
    if (fstat(file, &status) == 0) {
        if (!S_ISDIR(status.st_mode)) access &= ~std::uint64_t{LANDLOCK_ACCESS_FS_READ_DIR};
        const landlock_path_beneath_attr rule{.allowed_access = access, .parent_fd = file};
        syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    }
    close(file);
}

Folders listed_in(const char* variable, std::string_view usual = {}) {
    const char* value = std::getenv(variable);
    std::string_view text = value == nullptr ? usual : value;
    Folders folders;
    while (!text.empty()) {
        const auto end = text.find(':');
        if (const auto folder = text.substr(0, end); folder.starts_with('/'))
            folders.emplace_back(folder);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
    }
    return folders;
}

/// Where programs, their libraries and the modules of Python are. PREFIX/bin in the PATH means that
/// they are below PREFIX.
void allow_programs(int rules) {
    for (const fs::path& folder : listed_in("PATH", "/usr/local/bin:/usr/bin:/bin")) {
        allow(rules, folder, to_read);
        if (folder.filename() != "bin") continue;
        for (const char* part : {"lib", "lib64", "share", "pyvenv.cfg"})
            allow(rules, folder.parent_path() / part, to_read);
    }
    for (const char* variable : {"PYTHONPATH", "LD_LIBRARY_PATH"}) {
        for (const fs::path& folder : listed_in(variable))
            allow(rules, folder, to_read);
    }
    for (const char* place :
         {"/bin", "/lib", "/lib64", "/usr/bin", "/usr/lib", "/usr/lib64", "/usr/local/lib",
          "/usr/share", "/etc/ld.so.cache", "/etc/python3", "/etc/python3.11", "/dev/urandom"})
        allow(rules, place, to_read);
    allow(rules, "/dev/null", LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE);
}

}  // namespace

bool hold_program_to(const Folders& folders) {
    const landlock_ruleset_attr attributes{.handled_access_fs = held};
    const auto rules =
        static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0));
    if (rules < 0) return false;
    for (const fs::path& folder : folders)
        allow(rules, folder, to_read);
    allow_programs(rules);
    const bool holds = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                       syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    close(rules);
    return holds;
}

}  // namespace scipd::sim
