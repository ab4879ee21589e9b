// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The only file that knows stb_image. The library inflates whatever a file holds, however small the
// picture that its header promises; its memory therefore comes out of a purse that is filled by the
// header.
#include "sim/loaders/map/png.h"

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/loaders/quote.h"

namespace {

/// What stb_image may still allocate on this thread; what it frees is not given back.
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
#define STBI_NO_STDIO
#define STBI_MALLOC(size) paid_malloc(size)
#define STBI_REALLOC_SIZED(old, old_size, size) paid_realloc(old, old_size, size)
#define STBI_FREE(old) std::free(old)
#include <stb/stb_image.h>

namespace scipd::sim {
namespace {

struct Free {
    void operator()(void* samples) const { std::free(samples); }
};

constexpr std::size_t most_bytes = 1 << 29;

[[noreturn]] void refuse() {
    const char* reason = stbi_failure_reason();
    if (reason == nullptr) throw std::invalid_argument("is a broken PNG");
    if (std::string_view(reason) == "outofmem") {
        throw std::invalid_argument("is a broken PNG: it holds more than its header says");
    }
    throw std::invalid_argument("is a broken PNG: " + printable(reason));
}

/// What is told by the header alone.
void check_size(std::size_t width, std::size_t height, std::size_t bytes_a_pixel) {
    check_map_size(width, height);
    if (width * height * bytes_a_pixel <= most_bytes) return;
    throw std::invalid_argument("takes more than 512 MiB; save it in 8-bit grey");
}

template <typename Sample>
std::vector<Sample> taken(Sample* decoded, std::size_t count) {
    const std::unique_ptr<Sample, Free> owner{decoded};
    if (decoded == nullptr) refuse();
    return {decoded, decoded + count};
}

}  // namespace

bool is_png(std::string_view bytes) {
    return bytes.starts_with("\x89PNG");
}

MapImage read_png(std::string_view bytes) {
    if (bytes.size() > most_bytes) throw std::invalid_argument("is larger than 512 MiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    purse = 1 << 16;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) refuse();
    const bool is_wide = stbi_is_16_bit_from_memory(data, size) != 0;
    MapImage image{static_cast<std::size_t>(width),
                   static_cast<std::size_t>(height),
                   static_cast<unsigned>(channels),
                   is_wide ? 65535U : 255U,
                   {}};
    const std::size_t pixel = image.channels * (is_wide ? 2 : 1);
    check_size(image.width, image.height, pixel);
    // The file again, doubled as it grows; the rows with a filter byte each; the picture, once more
    // where it is interlaced, and both twice as large where one grey is said to be transparent.
    purse = 2 * bytes.size() + image.height + 5 * image.width * image.height * pixel + (1 << 16);
    const auto count = [&] { return image.width * image.height * static_cast<unsigned>(channels); };
    if (is_wide) {
        auto* samples = stbi_load_16_from_memory(data, size, &width, &height, &channels, 0);
        image.samples = taken(samples, count());
    } else {
        auto* samples = stbi_load_from_memory(data, size, &width, &height, &channels, 0);
        image.samples = taken(samples, count());
    }
    // Only now is it known that one grey is transparent.
    image.channels = static_cast<unsigned>(channels);
    return image;
}

}  // namespace scipd::sim
