// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes an MCAP file: messages in packed chunks, each chunk on the disk before the next begins, so
// that a process that is killed leaves a file whose chunks can be read. finish() adds the index, by
// which others seek. It knows no clock: a chunk ends when its messages span a second, or fill it.
// It has one owner, on any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/crc.hpp>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/mcap/mcap_format.h"

namespace scipd::sim::mcap {

enum class Compression { none, lz4, zstd };

struct WriterOptions {
    std::string library = "scipd";  ///< who writes; stands in the header
    Compression compression = Compression::zstd;
    std::size_t chunk_bytes = std::size_t{1} << 20;
    std::chrono::nanoseconds chunk_time{std::chrono::seconds{1}};
};

class Writer {
  public:
    /// Replaces an old file. This and all that write throw std::runtime_error.
    explicit Writer(const std::filesystem::path& path, WriterOptions options = {});

    /// Both return the id; they come before the first message.
    std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
    std::uint16_t add_channel(std::string topic, std::uint16_t schema, std::string encoding);
    void add_metadata(const Metadata& metadata);

    void write(std::uint16_t channel, std::uint64_t log_ns, std::string_view data);

    /// Nothing may follow. Without it the file has no index.
    void finish();

  private:
    /// Where a message lies in a chunk.
    struct Place {
        std::uint64_t log_ns;
        std::uint64_t offset;
    };
    struct ChunkIndex {
        Chunk chunk;  ///< without its records
        std::uint64_t packed_size;
        std::uint64_t offset;
        std::uint64_t length;
        std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< channel to offset
        std::uint64_t message_indexes_length;
    };
    struct MetadataIndex {
        std::uint64_t offset;
        std::uint64_t length;
        std::string name;
    };
    struct Group {
        Opcode opcode;
        std::uint64_t start;
        std::uint64_t length;
    };

    void put(std::string_view bytes);
    void end_chunk();
    void put_message_indexes(ChunkIndex& index);
    void put_summary();
    [[nodiscard]] std::string statistics() const;
    [[nodiscard]] static std::string chunk_index(const ChunkIndex& index);

    GrowingFile file_;
    WriterOptions options_;
    boost::crc_32_type crc_;  ///< of the data section so far, then of the summary
    std::vector<Schema> schemas_;
    std::vector<Channel> channels_;
    // The chunk that is being filled.
    std::string records_;
    std::uint64_t first_ns_ = 0;
    std::uint64_t last_ns_ = 0;
    std::map<std::uint16_t, std::vector<Place>> places_;  ///< by channel
    // What finish() tells of all that was written.
    std::map<std::uint16_t, std::uint64_t> message_counts_;  ///< by channel
    std::vector<ChunkIndex> chunks_;
    std::vector<MetadataIndex> metadata_;
};

}  // namespace scipd::sim::mcap
