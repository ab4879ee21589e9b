// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <limits>
#include <new>

#include <bzlib.h>

#include "sim/recording/compression/compression.h"

namespace scipd::sim {
namespace {

/// The library's state, which must be ended.
class Bzip2Stream {
  public:
    Bzip2Stream() {
        if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
    }
    ~Bzip2Stream() { BZ2_bzDecompressEnd(&stream_); }
    Bzip2Stream(const Bzip2Stream&) = delete;
    Bzip2Stream& operator=(const Bzip2Stream&) = delete;

    bz_stream& get() { return stream_; }

  private:
    bz_stream stream_{};
};

}  // namespace

Expected<std::string> unpack_bzip2(std::string_view packed, std::size_t most) {
    if (packed.size() > std::numeric_limits<unsigned>::max()) return refuse("is too large");
    Bzip2Stream owner;
    bz_stream& stream = owner.get();
    std::string input(packed);  // the library wants characters that could be written
    stream.next_in = input.data();
    stream.avail_in = static_cast<unsigned>(input.size());
    std::string piece(std::size_t{1} << 16, '\0');
    std::string bytes;
    int result = BZ_OK;
    while (result == BZ_OK) {
        stream.next_out = piece.data();
        stream.avail_out = static_cast<unsigned>(piece.size());
        result = BZ2_bzDecompress(&stream);
        if (result != BZ_OK && result != BZ_STREAM_END) return refuse("is no sound bzip2");
        const std::size_t made = piece.size() - stream.avail_out;
        bytes.append(piece, 0, made);
        if (bytes.size() > most)
            return refuse("makes more than " + std::to_string(most) + " bytes");
        if (result == BZ_OK && stream.avail_in == 0 && made == 0)
            return refuse("is bzip2 that was cut off");
    }
    return bytes;
}

}  // namespace scipd::sim
