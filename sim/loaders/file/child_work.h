// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The child's side of child_process.h: works within limits, writes the answer, and ends. Such a
// child has a single thread.
#pragma once

#include <cstdio>
#include <functional>

#include <sys/resource.h>
#include <sys/types.h>

#include "sim/loaders/file/confines.h"

namespace scipd::sim {

/// Works as a child of `parent`: a child without a parent ends at once.
[[noreturn]] void work_as_child(const Confines& confines, pid_t parent,
                                const std::function<void(std::FILE* out)>& work, std::FILE* out);

/// A template, since the type of a resource differs between C libraries.
template <typename Resource>
void limit(Resource resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(resource, &both);
}

}  // namespace scipd::sim
