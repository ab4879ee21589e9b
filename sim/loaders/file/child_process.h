// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A child process that does what cannot be trusted, such as reading a file from outside with a
// large library, and the file in memory that it answers with. This is the parent's side, and
// child_work.h is the child's. Any thread.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <sys/types.h>

#include "sim/loaders/file/confines.h"
#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {

class ChildProcess {
  public:
    /// What both sides have. Make it, start the child with it, and hand it over.
    struct Shared {
        File answer = memory_file();
        Doing doing;
    };

    /// The child has just been started, and ends with this object at the latest.
    ChildProcess(Confines confines, std::unique_ptr<Shared> shared, pid_t pid);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Waits for the child and returns what the work wrote, from its beginning; the work has no
    /// other effect on this process. Call it once. Throws std::runtime_error with the message of
    /// the exception that left the work, or with how the child ended; if it took too long, also
    /// with what it did last (doing.h).
    File outcome();

  private:
    class Process;

    void wait();
    [[nodiscard]] std::string too_late() const;

    Confines confines_;
    std::chrono::steady_clock::time_point deadline_;
    std::unique_ptr<Shared> shared_;
    std::unique_ptr<Process> process_;
};

/// Everything that the file holds from where it stands.
std::string rest_of(std::FILE* file);

}  // namespace scipd::sim
