// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/no_network.h"

#include <cerrno>
#include <memory>
#include <type_traits>

#include <seccomp.h>

namespace scipd::sim {
namespace {

struct Release {
    void operator()(scmp_filter_ctx filter) const { seccomp_release(filter); }
};
using Filter = std::unique_ptr<std::remove_pointer_t<scmp_filter_ctx>, Release>;

/// io_uring makes sockets, too.
constexpr int unneeded[] = {SCMP_SYS(socket),
                            SCMP_SYS(io_uring_setup),
                            SCMP_SYS(ptrace),
                            SCMP_SYS(process_vm_readv),
                            SCMP_SYS(process_vm_writev),
                            SCMP_SYS(pidfd_getfd),
                            SCMP_SYS(bpf),
                            SCMP_SYS(perf_event_open),
                            SCMP_SYS(userfaultfd),
                            SCMP_SYS(keyctl),
                            SCMP_SYS(add_key),
                            SCMP_SYS(unshare),
                            SCMP_SYS(setns),
                            SCMP_SYS(mount)};

bool forbid(const Filter& filter, int call) {
    return seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EACCES), call, 0) == 0;
}

}  // namespace

bool forbid_network(Programs programs) {
    const Filter filter{seccomp_init(SCMP_ACT_ALLOW)};
    if (!filter) return false;
    for (const int call : unneeded) {
        if (!forbid(filter, call)) return false;
    }
    if (programs == Programs::none &&
        (!forbid(filter, SCMP_SYS(execve)) || !forbid(filter, SCMP_SYS(execveat))))
        return false;
    return seccomp_load(filter.get()) == 0;
}

}  // namespace scipd::sim
