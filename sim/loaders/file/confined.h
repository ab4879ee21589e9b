// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Work that nobody here vouches for, such as a large library's on a file from outside, in a child
// process: what runs away, waits for ever, eats the memory or crashes ends the child and nothing
// else. Any thread.
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
    std::size_t memory_bytes;  ///< above what the process has already
    std::chrono::milliseconds wall_time = std::chrono::minutes{2};
    std::stop_token stop = {};  ///< when nobody waits for it any more
    /// What whoever reads that it took too much can do about it: "KEY allows more".
    std::string more_memory = {};
    std::string more_time = {};
};

/// `work` is alone on its thread, as after any fork(); it has standard input, output and error and
/// some descriptors to open files with. It ends with this object.
class Confined {
  public:
    Confined(Confines confines, const std::function<void(std::FILE* out)>& work);
    ~Confined();
    Confined(const Confined&) = delete;
    Confined& operator=(const Confined&) = delete;

    /// What the work wrote, from its beginning; nothing else that it does is seen here. Waits,
    /// once. Throws std::runtime_error: in the words of the exception that left the work, or saying
    /// how the child ended and, where that was late, what it said of itself (doing.h).
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

/// What a program prints on standard output, up to 256 MiB; nothing where there is no program of
/// this name on the PATH. It gets these words as they are, without a shell, and an empty standard
/// input. Throws std::runtime_error: as above, or with what a program that fails prints on standard
/// error.
std::optional<std::string> output_of(const Confines& confines,
                                     const std::vector<std::string>& command);

}  // namespace scipd::sim
