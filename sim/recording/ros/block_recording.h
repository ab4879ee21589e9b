// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file of messages in blocks, such as the chunks of a bag of ROS 1 or of an MCAP file: its
// messages in order of log time, in whatever order the file has them. Blocks that overlap in time
// are unpacked together, and no more than that. Of one owner; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recording/file/byte_reader.h"
#include "sim/recording/ros/laser_recording.h"

namespace scipd::sim {

class BlockRecording : public LaserRecording {
  public:
    using LaserRecording::LaserRecording;

    void skip_ahead(std::chrono::nanoseconds since_first) final {
        if (begin_ < HostTime::max() - since_first) skip_to_ = begin_ + since_first;
    }

  protected:
    /// A chunk, or a run of messages outside of chunks: bytes of the file that are read as one.
    struct Block {
        std::uint64_t byte = 0;
        std::uint64_t size = 0;
        HostTime first{};  ///< of its messages
        HostTime last{};
    };
    /// A message in an unpacked block.
    struct Message {
        HostTime time{};
        std::uint32_t channel = 0;
        std::uint32_t begin = 0;  ///< of its data
        std::uint32_t size = 0;
    };
    struct Unpacked {
        std::uint64_t byte = 0;  ///< of the block in the file
        std::string bytes;
        std::vector<Message> messages;
        std::size_t next = 0;  ///< the message that is not yet given

        void add(HostTime time, std::uint32_t channel, std::string_view data);
    };

    /// Takes record after record of the file. Damage up to a chunk that the index names goes to
    /// lose(). False where the file ends within a record, which gives a warning.
    bool walk(std::uint64_t byte);
    void add_chunk(const Block& chunk);
    /// Adds a message that stands outside of chunks, in the order of the file.
    void add_loose(const Block& message);
    /// Puts the blocks in order of time and unpacks the first. Without `knows_channels`, blocks
    /// that are not in order are all unpacked once in the order of the file, since a message may
    /// need a channel that an earlier block describes.
    void begin(bool knows_channels);
    /// Damage goes to lose().
    Unpacked unpack(const Block& block);

    std::vector<Block> blocks_;

  private:
    /// Takes the record of the file that begins at this byte, and returns where it ends; nullopt
    /// where none begins, or the file ends within it.
    virtual std::optional<std::uint64_t> take_record(std::uint64_t byte) = 0;
    /// The beginning of the next chunk behind this byte, by the index.
    [[nodiscard]] virtual std::optional<std::uint64_t> chunk_behind(std::uint64_t byte) = 0;
    /// The records in the bytes of a block, unpacked.
    [[nodiscard]] virtual Expected<std::string> records_of(std::string block) = 0;
    /// Takes the next record of a block; messages that may be wanted go into `unpacked`. Returns
    /// false if none begins, or it is not whole.
    virtual bool take_record(ByteReader& records, Unpacked& unpacked) = 0;
    [[nodiscard]] virtual Next item_of(const Message& message, std::string_view data) {
        return laser_item(message.channel, message.time, data);
    }

    Next do_next() final;
    void open_block(const Block& block);
    void open_early_blocks();

    std::vector<Unpacked> open_;  ///< a heap: the one with the earliest message is first
    std::size_t open_bytes_ = 0;
    std::size_t next_block_ = 0;
    bool loose_ = false;  ///< the last block is a run of messages
    HostTime begin_{};
    HostTime skip_to_ = HostTime::min();
};

}  // namespace scipd::sim
