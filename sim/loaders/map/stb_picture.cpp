// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The only file that uses stb_image. The library inflates all data of a file, even if its header
// announces a small picture; so a budget for its memory (`purse`) is computed from the header. It
// also reads missing data as zeros; so files that end early are refused here.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/loaders/map/map_picture.h"
#include "sim/text/quote.h"

namespace {

/// How many bytes stb_image may still allocate on this thread. Freeing memory adds nothing.
thread_local std::size_t purse = 0;

bool pay(std::size_t size) {
    if (size > purse) return false;
    purse -= size;
    return true;
}

void* paid_malloc(std::size_t size) {
    return pay(size) ? std::malloc(size) : nullptr;
}

void* paid_realloc(void* old, std::size_t old_size, std::size_t size) {
    return pay(size > old_size ? size - old_size : 0) ? std::realloc(old, size) : nullptr;
}

}  // namespace

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_MALLOC(size) paid_malloc(size)
#define STBI_REALLOC_SIZED(old, old_size, size) paid_realloc(old, old_size, size)
#define STBI_FREE(old) std::free(old)
// On faulty files the library copies 0 bytes to null, and overflows in shifts and sums. Neither
// does harm, so these checks are off for it; all its accesses to memory stay checked.
#ifdef __clang__
#pragma clang attribute push(                                                              \
    __attribute__((no_sanitize("nonnull-attribute", "shift", "signed-integer-overflow"))), \
    apply_to = function)
#endif
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif

namespace scipd::sim {
namespace {

struct Free {
    void operator()(void* samples) const { std::free(samples); }
};

constexpr std::size_t most_bytes = 1 << 29;

std::string kind_of(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "PNG";
    return bytes.starts_with("BM") ? "BMP" : "";
}

[[noreturn]] void refuse_broken(const std::string& kind, const std::string& why) {
    throw std::invalid_argument("is a broken " + kind + ": " + why);
}

[[noreturn]] void refuse_as_told(const std::string& kind) {
    const char* reason = stbi_failure_reason();
    if (reason == nullptr) throw std::invalid_argument("is a broken " + kind);
    const std::string_view words{reason};
    refuse_broken(kind,
                  words == "outofmem" ? "it holds more than its header says" : printable(words));
}

/// Checks the size that the header announces.
void check_size(std::size_t width, std::size_t height, std::size_t bytes_a_pixel) {
    check_map_size(width, height);
    if (width * height * bytes_a_pixel <= most_bytes) return;
    throw std::invalid_argument("takes more than 512 MiB; save it in 8-bit grey");
}

/// The parts of a BMP header that tell whether the file is complete and can be read.
class BmpHeader {
  public:
    explicit BmpHeader(std::string_view bytes) : bytes_(bytes) {
        if (bytes.size() < 34) refuse_broken("BMP", "it ends within its header");
    }

    void check() const {
        const bool has_runs = !is_short() && (number(30, 4) == 1 || number(30, 4) == 2);
        if (has_runs) {
            throw std::invalid_argument("is a BMP of run lengths; save it without compression");
        }
        const std::uint64_t width = is_short() ? number(18, 2) : number(18, 4);
        const std::uint64_t rows = is_short() ? number(20, 2) : height();
        check_map_size(width, rows);
        const std::uint64_t row = (width * number(is_short() ? 24 : 28, 2) + 31) / 32 * 4;
        // Many writers leave out the padding of the last row.
        const std::uint64_t wanted = number(10, 4) + rows * row - 3;
        if (wanted > bytes_.size()) {
            refuse_broken("BMP",
                          "it ends " + std::to_string(wanted - bytes_.size()) + " bytes too early");
        }
    }

  private:
    [[nodiscard]] bool is_short() const { return number(14, 4) == 12; }

    /// The header has a negative height if the rows come from the top.
    [[nodiscard]] std::uint64_t height() const {
        const auto said = static_cast<std::int32_t>(number(22, 4));
        return static_cast<std::uint64_t>(std::abs(std::int64_t{said}));
    }

    /// The less significant byte first.
    [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t size) const {
        std::uint32_t value = 0;
        for (std::size_t i = size; i > 0; --i)
            value = value << 8U | static_cast<std::uint8_t>(bytes_[at + i - 1]);
        return value;
    }

    std::string_view bytes_;
};

template <typename Sample>
std::vector<Sample> taken(Sample* decoded, std::size_t count, const std::string& kind) {
    const std::unique_ptr<Sample, Free> owner{decoded};
    if (decoded == nullptr) refuse_as_told(kind);
    return {decoded, decoded + count};
}

}  // namespace

bool is_stb_picture(std::string_view bytes) {
    return !kind_of(bytes).empty();
}

MapImage read_stb_picture(std::string_view bytes) {
    if (bytes.size() > most_bytes) throw std::invalid_argument("is larger than 512 MiB");
    const std::string kind = kind_of(bytes);
    if (kind == "BMP") BmpHeader{bytes}.check();
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    purse = 1 << 16;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) refuse_as_told(kind);
    const bool is_wide = stbi_is_16_bit_from_memory(data, size) != 0;
    MapImage image{static_cast<std::size_t>(width),
                   static_cast<std::size_t>(std::abs(height)),
                   static_cast<unsigned>(channels),
                   is_wide ? 65535U : 255U,
                   {}};
    const std::size_t pixel = image.channels * (is_wide ? 2 : 1);
    check_size(image.width, image.height, pixel);
    // This is enough for the file once more, in a buffer that doubles as it grows; for the rows
    // with a filter byte each; for the picture, and for another one if it is interlaced, both twice
    // as large if one grey is transparent.
    purse = 2 * bytes.size() + image.height + 5 * image.width * image.height * pixel + (1 << 16);
    const auto count = [&] { return image.width * image.height * static_cast<unsigned>(channels); };
    if (is_wide) {
        auto* samples = stbi_load_16_from_memory(data, size, &width, &height, &channels, 0);
        image.samples = taken(samples, count(), kind);
    } else {
        auto* samples = stbi_load_from_memory(data, size, &width, &height, &channels, 0);
        image.samples = taken(samples, count(), kind);
    }
    // Only decoding tells whether one grey is transparent, which adds a channel.
    image.channels = static_cast<unsigned>(channels);
    return image;
}

}  // namespace scipd::sim
