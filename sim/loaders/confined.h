// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Work that nobody here vouches for, such as a large library's on a file from outside, in a child
// process: what runs away, eats the memory or crashes ends the child and nothing else. Any thread;
// the caller waits.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>

namespace scipd::sim {

struct Confines {
    std::chrono::seconds processor_time;
    std::size_t memory_bytes;  ///< above what the process has already
};

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// What `work` wrote, from its beginning. Nothing else that it does is seen here. Throws
/// std::runtime_error: in the words of the exception that left `work`, or saying how the child
/// ended. `work` is alone on its thread, as after any fork().
File run_confined(const Confines& confines, const std::function<void(std::FILE* out)>& work);

}  // namespace scipd::sim
