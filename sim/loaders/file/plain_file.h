// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Opens files that a user named. A FIFO or a device in place of a file would block whoever opens
// it, so these are refused without opening them, and so is what lies where this process may not
// read (allowed_folder.h). Any thread; nothing shared.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "sim/expected.h"

namespace scipd::sim {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Whether the path names a plain file. The fault says why not: "no such file", "is a FIFO".
[[nodiscard]] Expected<> check_plain_file(const std::filesystem::path& path);

/// Opens the file for reading. Throws std::runtime_error that says why it cannot.
File open_file(const std::filesystem::path& path);

/// The first 4 KiB, enough to recognize the kind of file. Empty if it is no plain file. Throws as
/// open_file().
std::string beginning_of(const std::filesystem::path& path);

/// A file without a name, in memory. Throws std::runtime_error.
File memory_file();
/// Such a file as a descriptor, which is never one of the first four: these have a meaning of their
/// own in a child that is given it.
int memory_descriptor();

/// The whole file. Throws LoadError if the file cannot be read or is larger than `most_bytes`; the
/// message names the file and ends in `wanted`, which tells the user what should be there.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most_bytes,
                      const std::string& wanted);

/// Reads a text in UTF-8. If it is in UTF-16, the LoadError says so.
std::string read_text(const std::filesystem::path& path, std::uintmax_t most_bytes,
                      const std::string& wanted);

}  // namespace scipd::sim
