// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/text_recording.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace scipd::sim {

Expected<std::optional<RecordedItem>> TextRecording::do_next() {
    for (;;) {
        const auto line = next_line();
        if (!line) return tl::unexpected(line.error());
        if (!*line) return std::nullopt;
        if (cut_off_ && !is_whole(**line)) {
            warn(file_.name() + " ends within line " + std::to_string(line_number_) +
                 ", which is left out");
            return std::nullopt;
        }
        auto item = take(**line);
        if (!item) return file_.refuse_line(line_number_, item.error().why);
        if (*item) return item;
    }
}

Expected<std::optional<std::string_view>> TextRecording::next_line() {
    constexpr std::size_t piece = std::size_t{64} << 10;
    std::size_t end = text_.find('\n', begin_);
    while (end == std::string::npos) {
        const std::size_t searched = text_.size() - begin_;
        const auto more = file_.read(read_, piece);
        if (!more) return tl::unexpected(more.error());
        if (more->empty()) break;
        read_ += more->size();
        text_.erase(0, begin_);
        begin_ = 0;
        text_ += *more;
        end = text_.find('\n', searched);
        if (end == std::string::npos && text_.size() > longest_line) {
            return file_.refuse_line(
                line_number_ + 1, "the line is longer than any scan: this is no recording as text");
        }
    }
    if (begin_ == text_.size()) return std::nullopt;
    ++line_number_;
    cut_off_ = end == std::string::npos;
    std::string_view line = std::string_view(text_).substr(begin_, end - begin_);
    begin_ = cut_off_ ? text_.size() : end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line_number_ == 1 ? behind_byte_order_mark(line) : line;
}

std::size_t TextRecording::stream_of(const std::string& key, const RecordedStream& stream) {
    const auto [found, is_new] = streams_by_key_.try_emplace(key, 0);
    if (is_new) found->second = add_stream(stream);
    return found->second;
}

std::string_view take_until(std::string_view& text, std::string_view mark) {
    const std::string_view taken = text.substr(0, text.find(mark));
    text.remove_prefix(std::min(taken.size() + mark.size(), text.size()));
    return taken;
}

std::string_view behind_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string seconds_text(HostTime time) {
    using std::chrono::microseconds;
    const auto us = std::chrono::duration_cast<microseconds>(time.time_since_epoch()).count();
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%lld.%06lld", static_cast<long long>(us / 1000000),
                  static_cast<long long>(us % 1000000));
    return text.data();
}

std::string whole_text(double value) {
    return std::to_string(std::llround(value));
}

}  // namespace scipd::sim
