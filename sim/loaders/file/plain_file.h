// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Opening files that somebody named: a FIFO or a device in their place would block whoever opens
// it, and is refused unopened. Any thread; nothing shared.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace scipd::sim {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Why this cannot be read as a file: "no such file", "is a FIFO"; empty where it can.
std::string why_no_file(const std::filesystem::path& path);

/// For reading. Throws std::runtime_error, saying why it cannot be had.
File open_file(const std::filesystem::path& path);

/// As far as it tells what it is; empty where it is no plain file. Throws as open_file().
std::string beginning_of(const std::filesystem::path& path);

/// Without a name, in memory. Throws std::runtime_error.
File memory_file();

/// All of it. Throws LoadError, which names the file and says what is `wanted` there.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most_bytes,
                      const std::string& wanted);

/// The same of a text, which is UTF-8; one in UTF-16 is refused, and called so.
std::string read_text(const std::filesystem::path& path, std::uintmax_t most_bytes,
                      const std::string& wanted);

}  // namespace scipd::sim
