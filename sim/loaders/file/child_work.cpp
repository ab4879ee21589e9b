// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/child_work.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace scipd::sim {
namespace {

/// Enough for a world of about so many models, each of which is a file.
constexpr rlim_t most_descriptors = 1024;

/// The file stays open for the children of this process, which may be held to other folders
/// (landlock.h). There it still tells of this process, as large as they are when they begin.
std::size_t memory_in_use() {
    static const int sizes = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    std::array<char, 64> text{};
    if (pread(sizes, text.data(), text.size() - 1, 0) <= 0) return 0;
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return std::strtoull(text.data(), nullptr, 10) * page;
}

void enter(const Confines& confines, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(failed_with_words);  // it ended before the prctl()
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_NOFILE, most_descriptors);
    limit(RLIMIT_CPU, static_cast<rlim_t>(confines.processor_time.count()));
    limit(RLIMIT_AS, memory_in_use() + confines.memory_bytes);
}

}  // namespace

void work_as_child(const Confines& confines, pid_t parent,
                   const std::function<void(std::FILE* out)>& work, std::FILE* out) {
    // Made now, while there is memory for it.
    const std::string too_much =
        "takes more than " + std::to_string(confines.memory_bytes / 1'000'000) + " MB of memory" +
        (confines.more_memory.empty() ? "" : "; " + confines.more_memory);
    const auto leave_with = [out](const char* words) {
        std::rewind(out);
        if (ftruncate(fileno(out), 0) == 0) std::fputs(words, out);
        std::fflush(out);
        _exit(failed_with_words);
    };
    try {
        enter(confines, parent);
        work(out);
        if (std::fflush(out) != 0) leave_with("there is no memory left for its result");
        _exit(0);
    } catch (const std::bad_alloc&) {
        leave_with(too_much.c_str());
    } catch (const std::exception& error) {
        leave_with(error.what());
    } catch (...) {
        leave_with("ended with an unknown error");
    }
    _exit(failed_with_words);
}

}  // namespace scipd::sim
