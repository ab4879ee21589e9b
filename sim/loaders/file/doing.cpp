// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/doing.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <sys/mman.h>

namespace scipd::sim {
namespace {

constexpr std::size_t room = 4096;

/// Null if this process is no confined child.
char* said_here = nullptr;

}  // namespace

Doing::Doing() {
    void* memory = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    words_ = static_cast<char*>(memory);
}

Doing::~Doing() {
    munmap(words_, room);
}

void Doing::begin() {
    said_here = words_;
}

std::string Doing::last() const {
    return words_;
}

void now_doing(std::string_view what) {
    if (said_here == nullptr) return;
    const std::size_t length = std::min(what.size(), room - 1);
    std::copy_n(what.begin(), length, said_here);
    said_here[length] = '\0';
}

}  // namespace scipd::sim
