// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <memory>
#include <stdexcept>

#include <lz4frame.h>

#include "sim/recording/compression/compression.h"

namespace scipd::sim {
namespace {

struct FreeContext {
    void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};
using Context = std::unique_ptr<LZ4F_dctx, FreeContext>;

Context new_context() {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0)
        throw std::bad_alloc();
    return Context(context);
}

}  // namespace

Expected<std::string> unpack_lz4(std::string_view packed, std::size_t most) {
    const Context context = new_context();
    std::string piece(std::size_t{1} << 16, '\0');
    std::string bytes;
    std::size_t to_come = 0;
    bool full = false;  // the library may hold more than fitted into the last piece
    while (!packed.empty() || (full && to_come != 0)) {
        std::size_t made = piece.size();
        std::size_t taken = packed.size();
        to_come =
            LZ4F_decompress(context.get(), piece.data(), &made, packed.data(), &taken, nullptr);
        if (LZ4F_isError(to_come) != 0)
            return refuse("is no sound lz4: " + std::string(LZ4F_getErrorName(to_come)));
        packed.remove_prefix(taken);
        full = made == piece.size();
        bytes.append(piece, 0, made);
        if (bytes.size() > most)
            return refuse("makes more than " + std::to_string(most) + " bytes");
    }
    if (to_come != 0) return refuse("is lz4 that was cut off");
    return bytes;
}

std::string pack_lz4(std::string_view bytes) {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    const std::size_t size =
        LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr);
    if (LZ4F_isError(size) != 0) throw std::runtime_error(LZ4F_getErrorName(size));
    packed.resize(size);
    return packed;
}

}  // namespace scipd::sim
