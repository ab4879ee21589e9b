// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/block_recording.h"

#include <algorithm>

#include "sim/recording/compression/compression.h"

namespace scipd::sim {
namespace {

/// Bytes of overlapping blocks that are unpacked at a time. Beyond it the order is given up: a file
/// of one block for each topic would be unpacked whole.
constexpr std::size_t most_open_bytes = std::size_t{64} << 20;
/// Size of a run of messages, as that of a chunk of rosbag.
constexpr std::uint64_t most_run_bytes = std::uint64_t{768} << 10;

constexpr auto is_later = [](const auto& a, const auto& b) {
    const auto& [left, right] = std::pair(a.messages[a.next].time, b.messages[b.next].time);
    return std::pair(left, a.byte) > std::pair(right, b.byte);
};

}  // namespace

void BlockRecording::Unpacked::add(HostTime time, std::uint32_t channel, std::string_view data) {
    messages.push_back({time, channel, static_cast<std::uint32_t>(data.data() - bytes.data()),
                        static_cast<std::uint32_t>(data.size())});
}

bool BlockRecording::walk(std::uint64_t byte) {
    while (byte < file_.size() && !is_beyond_reading()) {
        if (const auto end = take_record(byte)) {
            byte = *end;
            continue;
        }
        const auto chunk = chunk_behind(byte);
        if (!chunk) {
            warn(file_.name() + " ends within the record at byte " + std::to_string(byte) +
                 ", which is lost: its recorder was stopped there");
            return false;
        }
        lose(file_.refuse_byte(byte,
                               "the record here is damaged, up to byte " + std::to_string(*chunk)));
        byte = *chunk;
    }
    return true;
}

void BlockRecording::add_chunk(const Block& chunk) {
    blocks_.push_back(chunk);
    loose_ = false;
}

void BlockRecording::add_loose(const Block& message) {
    Block* const run = loose_ && !blocks_.empty() ? &blocks_.back() : nullptr;
    const std::uint64_t end = message.byte + message.size;
    if (run != nullptr && message.first >= run->last && end - run->byte <= most_run_bytes) {
        run->size = end - run->byte;
        run->last = message.last;
        return;
    }
    blocks_.push_back(message);
    loose_ = true;
}

void BlockRecording::begin(bool knows_channels) {
    const auto first = [](const Block& block) { return block.first; };
    if (!knows_channels && !std::ranges::is_sorted(blocks_, {}, first)) {
        for (const Block& block : blocks_)
            unpack(block);
    }
    std::ranges::stable_sort(blocks_, {}, first);
    if (blocks_.empty()) return;
    begin_ = blocks_.front().first;
    open_block(blocks_[next_block_++]);
}

BlockRecording::Unpacked BlockRecording::unpack(const Block& block) {
    Unpacked unpacked{.byte = block.byte};
    const auto lose_block = [&](const std::string& why) {
        lose(file_.refuse_byte(block.byte,
                               "the chunk of " + std::to_string(block.size) + " bytes " + why));
        return std::move(unpacked);
    };
    if (is_beyond_reading()) return unpacked;
    if (block.size > largest_block) return lose_block("is too large");
    auto bytes = file_.read(block.byte, block.size);
    if (!bytes) {
        lose(tl::unexpected(bytes.error()));
        return unpacked;
    }
    bytes = records_of(std::move(*bytes));
    if (!bytes) return lose_block(bytes.error().why);
    unpacked.bytes = std::move(*bytes);
    ByteReader records(unpacked.bytes);
    while (!records.at_end()) {
        if (!take_record(records, unpacked)) return lose_block("ends within a record");
    }
    return unpacked;
}

void BlockRecording::open_block(const Block& block) {
    Unpacked unpacked = unpack(block);
    if (unpacked.messages.empty()) return;
    std::ranges::stable_sort(unpacked.messages, {}, &Message::time);
    open_bytes_ += unpacked.bytes.size();
    open_.push_back(std::move(unpacked));
    std::ranges::push_heap(open_, is_later);
}

/// Unpacks each block that may hold an earlier message than those that are unpacked.
void BlockRecording::open_early_blocks() {
    while (next_block_ < blocks_.size()) {
        const Block& block = blocks_[next_block_];
        if (!open_.empty() && (block.first >= open_.front().messages[open_.front().next].time ||
                               open_bytes_ > most_open_bytes))
            return;
        ++next_block_;
        if (block.last >= skip_to_) open_block(block);
    }
}

Recording::Next BlockRecording::do_next() {
    for (;;) {
        open_early_blocks();
        if (open_.empty() || is_beyond_reading()) return std::nullopt;
        std::ranges::pop_heap(open_, is_later);
        Unpacked& block = open_.back();
        const Message message = block.messages[block.next++];
        auto item =
            item_of(message, std::string_view(block.bytes).substr(message.begin, message.size));
        if (!item) lose(file_.refuse_byte(block.byte, item.error().why));
        if (block.next == block.messages.size()) {
            open_bytes_ -= block.bytes.size();
            open_.pop_back();
        } else {
            std::ranges::push_heap(open_, is_later);
        }
        if (item && *item) return item;
    }
}

}  // namespace scipd::sim
