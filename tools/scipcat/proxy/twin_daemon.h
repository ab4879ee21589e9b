// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd of our own that is the twin: from its start until this goes, and no longer. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "tools/target.h"
#include "tools/temporary_folder.h"

namespace scipd::tools {

class ChildProgram;

class TwinDaemon {
  public:
    /// Starts the scipd beside this program with the configuration, on free ports, and returns when
    /// it is ready. Throws WrongInput with what it said where it does not start, or where the
    /// configuration has not just one scanner.
    explicit TwinDaemon(const std::filesystem::path& configuration);
    TwinDaemon(const TwinDaemon&) = delete;
    TwinDaemon& operator=(const TwinDaemon&) = delete;
    ~TwinDaemon();

    /// Where its scanner listens.
    [[nodiscard]] const Target& target() const { return target_; }

  private:
    void wait_until_ready(const std::filesystem::path& configuration);

    TemporaryFolder folder_;
    std::unique_ptr<ChildProgram> scipd_;
    Target target_;
};

}  // namespace scipd::tools
