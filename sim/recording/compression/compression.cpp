// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/compression/compression.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// A level of Zstandard that packs as fast as a disk writes.
constexpr int fast_level = 1;
constexpr std::size_t piece_bytes = std::size_t{1} << 17;

template <auto release>
struct Release {
    void operator()(auto* state) const { release(state); }
};

/// The result of one step of a library.
struct Step {
    std::size_t read = 0;
    std::size_t made = 0;
    bool whole = false;  ///< the end has been reached
    std::string fault;
};

/// Calls `step(packed, room)` until all is unpacked, and `write` with what each step makes.
Expected<> unpack(std::string_view packed, bool& whole, const auto& step, const auto& write) {
    thread_local std::string piece(piece_bytes, '\0');
    bool full = false;  // the library may hold more than fitted into the last piece
    while (!packed.empty() || (full && !whole)) {
        const Step done = step(packed, piece);
        if (!done.fault.empty()) return refuse("is no sound " + done.fault);
        packed.remove_prefix(done.read);
        full = done.made == piece.size();
        whole = done.whole;
        const Expected<> written = write(std::string_view(piece).substr(0, done.made));
        if (!written) return written;
        if (done.read == 0 && done.made == 0) break;
    }
    return {};
}

Expected<std::string> unpack_block(std::string_view packed, std::uint64_t& left,
                                   const char* library, const auto& step) {
    constexpr std::size_t always = std::size_t{64} << 20;
    const auto most =
        std::min<std::uint64_t>(left, std::clamp(100 * packed.size(), always, largest_block));
    std::string bytes;
    bool whole = packed.empty();
    const auto done = unpack(packed, whole, step, [&](std::string_view piece) -> Expected<> {
        if (bytes.size() + piece.size() > most)
            return refuse("makes more than " + std::to_string(most) + " bytes");
        // Doubled beyond this, it would take twice the memory of the largest.
        if (bytes.capacity() < bytes.size() + piece.size() && bytes.size() >= always)
            bytes.reserve(most);
        bytes += piece;
        return {};
    });
    left -= bytes.size();
    if (!done) return tl::unexpected(done.error());
    if (!whole) return refuse(std::string("is ") + library + " that was cut off");
    return bytes;
}

/// Unpacks one frame of Zstandard after the other.
auto zstd_step(ZSTD_DStream* stream) {
    return [stream](std::string_view packed, std::string& piece) {
        ZSTD_inBuffer in{packed.data(), packed.size(), 0};
        ZSTD_outBuffer out{piece.data(), piece.size(), 0};
        const std::size_t to_come = ZSTD_decompressStream(stream, &out, &in);
        Step step{in.pos, out.pos, to_come == 0, {}};
        if (ZSTD_isError(to_come) != 0)
            step.fault = "zstd: " + std::string(ZSTD_getErrorName(to_come));
        return step;
    };
}

std::unique_ptr<ZSTD_DStream, Release<ZSTD_freeDStream>> zstd_stream() {
    return std::unique_ptr<ZSTD_DStream, Release<ZSTD_freeDStream>>(ZSTD_createDStream());
}

Expected<std::string> zstd_block(std::string_view packed, std::uint64_t& left) {
    // Made once: a file may have a million blocks.
    thread_local const auto stream = zstd_stream();
    ZSTD_DCtx_reset(stream.get(), ZSTD_reset_session_only);
    return unpack_block(packed, left, "zstd", zstd_step(stream.get()));
}

Expected<std::string> lz4_block(std::string_view packed, std::uint64_t& left) {
    LZ4F_dctx* created = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0)
        throw std::bad_alloc();
    const std::unique_ptr<LZ4F_dctx, Release<LZ4F_freeDecompressionContext>> context(created);
    return unpack_block(packed, left, "lz4", [&](std::string_view rest, std::string& piece) {
        Step step{rest.size(), piece.size(), false, {}};
        const std::size_t to_come = LZ4F_decompress(context.get(), piece.data(), &step.made,
                                                    rest.data(), &step.read, nullptr);
        step.whole = to_come == 0;
        if (LZ4F_isError(to_come) != 0)
            step.fault = "lz4: " + std::string(LZ4F_getErrorName(to_come));
        return step;
    });
}

Expected<std::string> bzip2_block(std::string_view packed, std::uint64_t& left) {
    if (packed.size() > std::numeric_limits<unsigned>::max()) return refuse("is too large");
    bz_stream stream{};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
    const std::unique_ptr<bz_stream, Release<BZ2_bzDecompressEnd>> end(&stream);
    return unpack_block(packed, left, "bzip2", [&](std::string_view rest, std::string& piece) {
        // The library wants characters that could be written, but writes none.
        stream.next_in = const_cast<char*>(rest.data());
        stream.avail_in = static_cast<unsigned>(rest.size());
        stream.next_out = piece.data();
        stream.avail_out = static_cast<unsigned>(piece.size());
        const int result = BZ2_bzDecompress(&stream);
        Step step{rest.size() - stream.avail_in,
                  piece.size() - stream.avail_out,
                  result == BZ_STREAM_END,
                  {}};
        // Bytes behind the end of the stream are of no block.
        if (step.whole) step.read = rest.size();
        if (result != BZ_OK && !step.whole) step.fault = "bzip2";
        return step;
    });
}

std::string pack_zstd(std::string_view bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), fast_level);
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
    packed.resize(size);
    return packed;
}

std::string pack_lz4(std::string_view bytes) {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    const std::size_t size =
        LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr);
    if (LZ4F_isError(size) != 0) throw std::runtime_error(LZ4F_getErrorName(size));
    packed.resize(size);
    return packed;
}

}  // namespace

Expected<std::string> unpack(std::string_view method, std::string_view packed,
                             std::uint64_t& left) {
    if (method.empty() || method == "none") return std::string(packed);
    if (method == "zstd") return zstd_block(packed, left);
    if (method == "lz4") return lz4_block(packed, left);
    if (method == "bz2") return bzip2_block(packed, left);
    return refuse("is packed by " + quote(method) + ", which is unknown");
}

Expected<> unpack_zstd(const std::function<Expected<std::string>()>& read,
                       const std::function<Expected<>(std::string_view)>& write) {
    const auto stream = zstd_stream();
    bool whole = true;
    for (;;) {
        const auto packed = read();
        if (!packed) return tl::unexpected(packed.error());
        if (packed->empty()) break;
        const auto done = unpack(*packed, whole, zstd_step(stream.get()), write);
        if (!done) return done;
    }
    if (!whole) return refuse("is zstd that was cut off");
    return {};
}

std::string pack(std::string_view method, std::string_view bytes) {
    return method == "zstd"  ? pack_zstd(bytes)
           : method == "lz4" ? pack_lz4(bytes)
                             : std::string(bytes);
}

}  // namespace scipd::sim
