// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The test's side of the keeper: a scipd in a new folder of its own. It ends with this object, and
// with the test however that ends. One thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scipd::testing {

class KeptProcess {
  public:
    using Folder = std::filesystem::path;

    /// `command_in` tells the command for a scipd in this folder. Throws std::system_error.
    explicit KeptProcess(const std::function<std::vector<std::string>(const Folder&)>& command_in);
    KeptProcess(const KeptProcess&) = delete;
    KeptProcess& operator=(const KeptProcess&) = delete;
    ~KeptProcess() { end(); }

    /// The first line on its standard output. Empty: it has ended, or said nothing in time.
    [[nodiscard]] std::string first_line(std::chrono::milliseconds patience) const;
    /// -1: it could not be started.
    [[nodiscard]] int pid() const { return pid_; }
    /// Nothing: it still runs when the patience is over. A negative code is that of the signal that
    /// ended it.
    std::optional<int> exit_code(std::chrono::milliseconds patience = {});
    /// What it has told on standard error, also after end().
    [[nodiscard]] std::string log() const;

    /// Ends it and removes its folder. What this process has forked may not.
    void end() noexcept;

  private:
    void start(const std::vector<std::string>& command);
    std::optional<int> hear(std::chrono::milliseconds patience) const;

    Folder folder_;
    int owner_;          ///< the number of this process
    int keeper_ = -1;    ///< its number; -1: it has ended
    int messages_ = -1;  ///< to the keeper
    int output_ = -1;    ///< of scipd
    int pid_ = -1;
    std::optional<int> exit_code_;
    std::string last_log_;
};

}  // namespace scipd::testing
