// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Runs work that cannot be trusted, such as a large library reading a file from outside, in a child
// process. If the work loops, hangs, takes all memory or crashes, only the child ends. Any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {

struct Confines {
    std::chrono::seconds processor_time;
    std::size_t memory_bytes;  ///< on top of what the process already uses
    std::chrono::milliseconds wall_time = std::chrono::minutes{2};
    std::stop_token stop = {};  ///< requested when nobody waits any more
    /// Advice at the end of the message that the work took too much: "KEY allows more".
    std::string more_memory = {};
    std::string more_time = {};
};

/// Runs `work` in a child, which has a single thread, as after any fork(). The work has standard
/// input, output and error, and may open some files. The child ends with this object.
class Confined {
  public:
    Confined(Confines confines, const std::function<void(std::FILE* out)>& work);
    ~Confined();
    Confined(const Confined&) = delete;
    Confined& operator=(const Confined&) = delete;

    /// Waits for the child and returns what the work wrote, from its beginning; the work has no
    /// other effect on this process. Call it once. Throws std::runtime_error with the message of
    /// the exception that left the work, or with how the child ended; if it took too long, also
    /// with what it did last (doing.h).
    File outcome();

  private:
    class Child;

    void wait();
    [[nodiscard]] std::string too_late() const;

    Confines confines_;
    std::chrono::steady_clock::time_point deadline_;
    File file_;
    Doing doing_;
    std::unique_ptr<Child> child_;
};

inline File run_confined(const Confines& confines,
                         const std::function<void(std::FILE* out)>& work) {
    return Confined{confines, work}.outcome();
}

/// Runs a program and returns what it prints on standard output, up to 256 MiB; nothing if the PATH
/// has no program of this name. The program gets these words as they are, without a shell, and an
/// empty standard input. Throws std::runtime_error as outcome() does or, if the program fails, with
/// what it printed on standard error.
std::optional<std::string> output_of(const Confines& confines,
                                     const std::vector<std::string>& command);

}  // namespace scipd::sim
