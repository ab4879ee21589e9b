// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/line_file.h"

namespace scipd::sim {

Expected<std::optional<std::string_view>> LineFile::next() {
    constexpr std::size_t piece = std::size_t{64} << 10;
    std::size_t end = text_.find('\n', begin_);
    while (end == std::string::npos) {
        const std::size_t searched = text_.size() - begin_;
        auto more = file_.read(read_, piece);
        if (!more) return tl::unexpected(more.error());
        if (more->empty()) break;
        read_ += more->size();
        text_.erase(0, begin_);
        begin_ = 0;
        text_ += *more;
        end = text_.find('\n', searched);
        if (end == std::string::npos && text_.size() > longest_line) {
            ++number_;
            return refuse("the line is longer than any scan: this is no recording as text");
        }
    }
    if (begin_ == text_.size()) return std::nullopt;
    ++number_;
    cut_off_ = end == std::string::npos;
    std::string_view line = std::string_view(text_).substr(begin_, end - begin_);
    if (cut_off_) line = std::string_view(text_).substr(begin_);
    begin_ = cut_off_ ? text_.size() : end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

}  // namespace scipd::sim
