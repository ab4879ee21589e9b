// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The lines of a file, one after the other. Of one owner; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/file/input_file.h"

namespace scipd::sim {

class LineFile {
  public:
    /// A scan of 100 000 steps with echoes takes 3 MB.
    static constexpr std::size_t longest_line = std::size_t{16} << 20;

    explicit LineFile(InputFile file) : file_(std::move(file)) {}

    /// The next line without its end, until the next call; nothing at the end of the file. Refuses
    /// one that is too long.
    [[nodiscard]] Expected<std::optional<std::string_view>> next();

    /// Counts from 1.
    [[nodiscard]] std::size_t number() const { return number_; }
    /// Whether the line has no end: a writer may have been stopped within it.
    [[nodiscard]] bool is_cut_off() const { return cut_off_; }
    [[nodiscard]] const std::string& name() const { return file_.name(); }

    /// "FILE:LINE: WHY"
    [[nodiscard]] tl::unexpected<Fault> refuse(const std::string& why) const {
        return file_.refuse_line(number_, why);
    }

  private:
    InputFile file_;
    std::uint64_t read_ = 0;
    std::string text_;       ///< what was read and not yet given
    std::size_t begin_ = 0;  ///< of the next line in it
    std::size_t number_ = 0;
    bool cut_off_ = false;
};

}  // namespace scipd::sim
