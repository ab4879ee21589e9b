// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/file/growing_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace scipd::sim {

GrowingFile::GrowingFile(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary | std::ios::trunc) {
    check();
}

void GrowingFile::write(std::string_view bytes) {
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    check();
    size_ += bytes.size();
}

void GrowingFile::flush() {
    file_.flush();
    check();
}

void GrowingFile::check() const {
    if (!file_)
        throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace scipd::sim
