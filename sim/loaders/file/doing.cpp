// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/doing.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {
namespace {

constexpr std::size_t room = 4096;

/// Null if this process is no child.
char* said_here = nullptr;

}  // namespace

Doing::Doing() : descriptor_(memory_descriptor()) {
    if (ftruncate(descriptor_, room) == 0) return;
    const int error = errno;
    close(descriptor_);
    throw std::system_error(error, std::generic_category(), "ftruncate");
}

Doing::~Doing() {
    close(descriptor_);
}

std::string Doing::last() const {
    std::string words(room, '\0');
    if (pread(descriptor_, words.data(), words.size(), 0) < 0) return {};
    return words.c_str();
}

void begin_doing(int descriptor) {
    void* memory = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    said_here = memory == MAP_FAILED ? nullptr : static_cast<char*>(memory);
}

void now_doing(std::string_view what) {
    if (said_here == nullptr) return;
    const std::size_t length = std::min(what.size(), room - 1);
    std::copy_n(what.begin(), length, said_here);
    said_here[length] = '\0';
}

}  // namespace scipd::sim
