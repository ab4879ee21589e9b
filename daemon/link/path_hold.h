// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Holds a path for one scipd, as long as that one lives. Another scipd is refused the path;
// whatever the holder finds there was left behind by a scipd that was killed. The holder has locked
// (flock(2)) a file beside the path, .NAME.lock, which nobody else can open; so nobody else can
// keep the path from it. Spellings of the folder do not matter. A scipd that was killed leaves the
// file behind without its lock. Other programs know nothing of this. Waits for nothing; one thread.
#pragma once

#include <filesystem>
#include <stdexcept>

namespace scipd::daemon {

/// Somebody else uses the path. The message says who, where that can be told, and what to do.
class PathHeld : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class PathHold {
  public:
    /// The folder must exist, the file need not. Throws PathHeld, or std::system_error where no
    /// file can be made there.
    explicit PathHold(const std::filesystem::path& path);
    PathHold(const PathHold&) = delete;
    PathHold& operator=(const PathHold&) = delete;
    ~PathHold();

  private:
    std::filesystem::path lock_;
    int descriptor_;
};

/// Removes those whose process is gone and that nobody holds (path_hold). Leaves all else, and what
/// it cannot remove.
void remove_leftovers(const std::filesystem::path& run_directory);

}  // namespace scipd::daemon
