// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How much of the processors a process has used since it began, by the kernel's own count. Values.
#pragma once

#include <map>
#include <optional>
#include <string>

#include <sys/types.h>

namespace scipd::tools {

struct ThreadUse {
    std::string name;
    double ran_s = 0.0;
    double waited_s = 0.0;  ///< it could have run, but others had all processors
};

struct ProcessorUse {
    double user_s = 0.0;
    double kernel_s = 0.0;
    std::map<pid_t, ThreadUse> threads;  ///< that have not ended

    [[nodiscard]] double waited_s() const;
};

/// Nothing where there is no such process any more.
std::optional<ProcessorUse> processor_use_of(pid_t process);

/// What was used since an earlier look, a second: 1 is all of one processor.
ProcessorUse use_between(const ProcessorUse& earlier, const ProcessorUse& later, double seconds);

/// The thread that ran most.
ThreadUse busiest_of(const ProcessorUse& use);

}  // namespace scipd::tools
