// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tty_link.h"

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <spdlog/spdlog.h>
#include <sys/stat.h>

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

const std::string other_name = "; choose another name for the tty";

bool is_terminal(const fs::path& path) {
    const std::string number = path.filename();
    return path.parent_path() == "/dev/pts" &&
           number.find_first_not_of("0123456789") == std::string::npos;
}

auto in_order(const timespec& at) {
    return std::pair(at.tv_sec, at.tv_nsec);
}

// As a program leaves it that opens a tty with O_CREAT.
bool is_empty_since(const fs::path& path, const timespec& since) {
    struct stat file = {};
    return ::lstat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode) && file.st_size == 0 &&
           file.st_nlink == 1 && in_order(file.st_mtim) >= in_order(since);
}

// The numbers of terminals are given again: one that is younger than the link is not the one that
// the link was made for, which is gone.
bool leads_to_its_own(const fs::path& link) {
    struct stat made = {};
    struct stat terminal = {};
    if (::lstat(link.c_str(), &made) != 0 || ::stat(link.c_str(), &terminal) != 0) return false;
    return in_order(terminal.st_ctim) <= in_order(made.st_mtim);
}

/// Only a link of a scipd that was killed; nobody who lives holds it.
void remove_left_behind(const fs::path& link) {
    if (!fs::is_symlink(link))
        throw std::runtime_error(link.string() + " is there and is no link; remove it, or" +
                                 other_name.substr(1));
    const fs::path target = fs::read_symlink(link);
    const std::string leads = link.string() + " leads to " + target.string();
    if (!is_terminal(target))
        throw std::runtime_error(leads + ", which is no tty of scipd's; remove it, or" +
                                 other_name.substr(1));
    if (leads_to_its_own(link))
        throw PathHeld(leads + ", a tty of another program; end that one, or" +
                       other_name.substr(1));
    fs::remove(link);
}

std::runtime_error no_link(const fs::path& path, const std::system_error& error) {
    return std::runtime_error("cannot make the link " + path.string() + ": " +
                              error.code().message() + other_name);
}

PathHold hold(const fs::path& path) {
    try {
        if (path.has_parent_path()) fs::create_directories(path.parent_path());
        return PathHold(path);
    } catch (const std::system_error& error) {
        throw no_link(path, error);
    }
}

}  // namespace

TtyLink::TtyLink(const fs::path& path) : path_(path), hold_(hold(path)) {}

void TtyLink::lead_to(const fs::path& terminal) {
    if (terminal == terminal_) return;
    try {
        if (away_since_ && is_empty_since(path_, *away_since_)) {
            fs::remove(path_);
            spdlog::info("{}: an empty file, made while there was no tty, is removed",
                         path_.string());
        }
        if (fs::exists(fs::symlink_status(path_))) remove_left_behind(path_);
        fs::create_symlink(terminal, path_);
        terminal_ = terminal;
        away_since_.reset();
    } catch (const std::system_error& error) {
        throw no_link(path_, error);
    }
}

void TtyLink::remove() {
    std::error_code none;
    const fs::path terminal = std::exchange(terminal_, {});
    if (terminal.empty()) return;
    if (fs::read_symlink(path_, none) == terminal) fs::remove(path_, none);
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME_COARSE, &now);
    away_since_ = now;
}

}  // namespace scipd::daemon
