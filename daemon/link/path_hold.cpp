// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/path_hold.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

fs::path lock_of(const fs::path& path) {
    return path.parent_path() / ("." + path.filename().string() + ".lock");
}

/// 0 where the holder has not written it yet.
pid_t holder_of(int lock) {
    std::array<char, 16> text{};
    const ssize_t size = ::pread(lock, text.data(), text.size(), 0);
    pid_t holder = 0;
    if (size > 0) std::from_chars(text.data(), text.data() + size, holder);
    return holder;
}

std::string who(pid_t holder) {
    const std::string end_it = "; end that one, or choose another path";
    if (holder == 0) return "another scipd" + end_it;
    if (holder == ::getpid()) return "this scipd for something else; choose another path";
    return "another scipd, process " + std::to_string(holder) + end_it;
}

/// In a folder such as /tmp anybody may have been first. A second name of a file is not scipd's.
void refuse_what_is_not_ours(const fs::path& path, const fs::path& lock, const struct stat& found) {
    const std::string choose = "; choose another path, or have that file removed";
    if (found.st_uid != ::geteuid()) {
        throw PathHeld(path.string() + " is kept by user " + std::to_string(found.st_uid) +
                       ", who owns " + lock.string() + choose);
    }
    if (!S_ISREG(found.st_mode) || found.st_nlink > 1)
        throw PathHeld(path.string() + " cannot be held: " + lock.string() +
                       " is there and is no lock of scipd's" + choose);
}

bool is_still(const fs::path& lock, int descriptor) {
    struct stat named = {};
    struct stat opened = {};
    return ::lstat(lock.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
           named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

int open_lock(const fs::path& path, const fs::path& lock) {
    const int descriptor =
        ::open(lock.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR);
    const std::error_code error(errno, std::generic_category());
    struct stat found = {};
    if (descriptor < 0) {
        if (::lstat(lock.c_str(), &found) == 0) refuse_what_is_not_ours(path, lock, found);
        throw std::system_error(error, lock.string());
    }
    try {
        if (::fstat(descriptor, &found) == 0) refuse_what_is_not_ours(path, lock, found);
    } catch (const PathHeld&) {
        ::close(descriptor);
        throw;
    }
    return descriptor;
}

/// Closes it where it fails.
void take(const fs::path& path, int lock) {
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    const pid_t holder = holder_of(lock);
    ::close(lock);
    if (error == EWOULDBLOCK) throw PathHeld(path.string() + " is used by " + who(holder));
    throw std::system_error(error, std::generic_category(), path.string());
}

void sign(int lock) {
    const std::string text = std::to_string(::getpid()) + "\n";
    if (::ftruncate(lock, 0) == 0) (void)!::pwrite(lock, text.data(), text.size(), 0);
}

/// Again where the one that had it removed the file between the two steps.
int locked(const fs::path& path, const fs::path& lock) {
    while (true) {
        const int descriptor = open_lock(path, lock);
        take(path, descriptor);
        if (is_still(lock, descriptor)) return descriptor;
        ::close(descriptor);
    }
}

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

PathHold::PathHold(const fs::path& path) : lock_(lock_of(path)), descriptor_(locked(path, lock_)) {
    sign(descriptor_);
}

PathHold::~PathHold() {
    if (is_still(lock_, descriptor_)) ::unlink(lock_.c_str());
    ::close(descriptor_);
}

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
