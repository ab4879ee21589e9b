// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply.h"

#include <utility>

#include "protocol/checksum.h"
#include "protocol/data_block.h"

namespace scipd::protocol {

Reply::Reply(std::string_view echo, Status status) {
    text_.append(echo).push_back('\n');
    line(status.text());
}

Reply& Reply::line(std::string_view text) {
    text_.append(text).push_back(checksum(text));
    text_.push_back('\n');
    return *this;
}

Reply& Reply::entry(std::string_view key, std::string_view value) {
    std::string text;
    text.append(key).append(":").append(value);
    text_.append(text).append(";").push_back(checksum(text));
    text_.push_back('\n');
    return *this;
}

Reply& Reply::entry(std::string_view key, int value) {
    return entry(key, std::to_string(value));
}

Reply& Reply::data(std::span<const std::uint32_t> values, int width) {
    constexpr std::size_t end_of_message = 1;
    text_.reserve(text_.size() + data_block_size(values.size(), width) + end_of_message);
    append_data_block(text_, values, width);
    return *this;
}

Reply& Reply::data(std::string_view characters) {
    append_data_block(text_, characters);
    return *this;
}

std::string Reply::finish() {
    text_.push_back('\n');
    return std::move(text_);
}

}  // namespace scipd::protocol
