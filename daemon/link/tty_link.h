// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The name of a tty: a symlink that leads to one pseudo-terminal after the other, or is away while
// there is none. The name is held all the time. Lives on its shard.
#pragma once

#include <ctime>
#include <filesystem>
#include <optional>

#include "daemon/link/path_hold.h"

namespace scipd::daemon {

class TtyLink {
  public:
    /// Makes its folder and holds the name. Throws PathHeld where somebody uses it, else
    /// std::runtime_error.
    explicit TtyLink(const std::filesystem::path& path);
    TtyLink(const TtyLink&) = delete;
    TtyLink& operator=(const TtyLink&) = delete;
    /// As remove().
    ~TtyLink() { remove(); }

    /// Makes the link, in place of one that a scipd left behind that was killed, or of an empty
    /// file that was made since remove(), but of nothing else. Throws as the constructor. Where it
    /// has been made already it stays as it is.
    void lead_to(const std::filesystem::path& terminal);
    void remove();

  private:
    std::filesystem::path path_;
    PathHold hold_;
    std::filesystem::path terminal_;      ///< empty: it is away
    std::optional<timespec> away_since_;  ///< after remove(), as files are stamped
};

}  // namespace scipd::daemon
