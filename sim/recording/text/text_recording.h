// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the recordings that are text share: a line that is wrong is a fault. A last line without an
// end is left out, since a writer may have been stopped within it, and its last number may lack
// digits. Of one owner; any thread.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/text/line_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

class TextRecording : public Recording {
  public:
    TextRecording(std::string format, InputFile file)
        : Recording(std::move(format)), lines_(std::move(file)) {}

  protected:
    /// Takes a line; returns the item that it completes, if any, or says what is wrong.
    [[nodiscard]] virtual Next take(std::string_view line) = 0;

    [[nodiscard]] const LineFile& lines() const { return lines_; }

  private:
    Next do_next() final {
        for (;;) {
            const auto line = lines_.next();
            if (!line) return tl::unexpected(line.error());
            if (!*line) return std::nullopt;
            if (lines_.is_cut_off() && !is_whole(**line)) {
                warn(lines_.name() + " ends within line " + std::to_string(lines_.number()) +
                     ", which is left out");
                return std::nullopt;
            }
            auto item = take(**line);
            if (!item) return lines_.refuse(item.error().why);
            if (*item) return item;
        }
    }

    /// Whether a line without an end shows by itself that nothing is missing.
    [[nodiscard]] virtual bool is_whole(std::string_view line) const { return line.empty(); }

    LineFile lines_;
};

}  // namespace scipd::sim
