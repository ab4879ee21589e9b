// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files of recordings: one that is read in pieces, from a disk or from memory, and one that grows.
// Of one owner; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "sim/expected.h"

namespace scipd::sim {

class InputFile {
  public:
    /// Refuses what is no plain file, without opening it: a FIFO would block.
    [[nodiscard]] static Expected<InputFile> open(const std::filesystem::path& path);
    /// A file in memory; `name` stands in messages.
    [[nodiscard]] static InputFile of_bytes(std::string name, std::string bytes);

    /// Fit for messages.
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Changes the name that stands in messages.
    void call(std::string name) { name_ = std::move(name); }
    /// Where the file is on a disk; empty for one in memory.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Up to `count` bytes from `offset` on; fewer where the file ends before.
    [[nodiscard]] Expected<std::string> read(std::uint64_t offset, std::size_t count);

    /// Hands the file to a library that reads it from its beginning.
    [[nodiscard]] std::FILE* release();

    /// "FILE: byte 12: WHY"
    [[nodiscard]] tl::unexpected<Fault> refuse_byte(std::uint64_t byte,
                                                    const std::string& why) const;
    /// "FILE:12: WHY"
    [[nodiscard]] tl::unexpected<Fault> refuse_line(std::size_t line, const std::string& why) const;
    /// "FILE: WHY"
    [[nodiscard]] tl::unexpected<Fault> refuse(const std::string& why) const;

  private:
    /// Bytes that are read at once where fewer are asked for.
    static constexpr std::size_t window_bytes = std::size_t{16} << 10;

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::string name_;
    std::filesystem::path path_;
    std::unique_ptr<std::string> bytes_;  ///< of a file in memory; stays where it is
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t size_ = 0;
    std::string window_;  ///< the last bytes that were read
    std::uint64_t window_begin_ = 0;
};

/// A file that a recording is written to, piece after piece.
class GrowingFile {
  public:
    /// Replaces an old file. Throws std::runtime_error.
    explicit GrowingFile(const std::filesystem::path& path);

    /// Throws std::runtime_error where the disk is full.
    void write(std::string_view bytes);
    /// Has all that was written stay, even if the process is killed. Throws as write().
    void flush();

    /// Count of bytes that were written.
    [[nodiscard]] std::uint64_t size() const { return size_; }

  private:
    void check() const;

    std::filesystem::path path_;
    std::ofstream file_;
    std::uint64_t size_ = 0;
};

}  // namespace scipd::sim
