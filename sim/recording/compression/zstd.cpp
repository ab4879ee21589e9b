// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <memory>
#include <stdexcept>

#include <zstd.h>

#include "sim/recording/compression/compression.h"

namespace scipd::sim {
namespace {

struct FreeStream {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};

/// One that packs as fast as a disk writes.
constexpr int fast_level = 1;

}  // namespace

Expected<std::string> unpack_zstd(std::string_view packed, std::size_t most) {
    const std::unique_ptr<ZSTD_DStream, FreeStream> stream(ZSTD_createDStream());
    std::string piece(ZSTD_DStreamOutSize(), '\0');
    std::string bytes;
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    std::size_t to_come = 0;
    bool full = false;  // the library may hold more than fitted into the last piece
    while (in.pos < in.size || (full && to_come != 0)) {
        ZSTD_outBuffer out{piece.data(), piece.size(), 0};
        to_come = ZSTD_decompressStream(stream.get(), &out, &in);
        if (ZSTD_isError(to_come) != 0)
            return refuse("is no sound zstd: " + std::string(ZSTD_getErrorName(to_come)));
        full = out.pos == out.size;
        bytes.append(piece, 0, out.pos);
        if (bytes.size() > most)
            return refuse("makes more than " + std::to_string(most) + " bytes");
    }
    if (to_come != 0) return refuse("is zstd that was cut off");
    return bytes;
}

std::string pack_zstd(std::string_view bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), fast_level);
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
    packed.resize(size);
    return packed;
}

}  // namespace scipd::sim
