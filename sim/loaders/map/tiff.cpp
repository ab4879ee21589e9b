// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The only file that knows libtiff. It decodes into 8 bits a sample, whatever the file has: strips
// or tiles, palettes, and every compression that the library was built with.
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include <tiffio.h>
#include <unistd.h>

#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/map/map_picture.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// The first error of the library on this thread; it is the cause of the others.
thread_local std::string first_error;

void keep_error(const char*, const char* format, std::va_list arguments) {
    if (!first_error.empty()) return;
    std::array<char, 300> text{};
    std::vsnprintf(text.data(), text.size(), format, arguments);
    first_error = text.data();
}

[[noreturn]] void refuse_broken_tiff() {
    throw std::invalid_argument("is a broken TIFF" +
                                (first_error.empty() ? "" : ": " + printable(first_error)));
}

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

TiffFile open_tiff(std::string_view bytes) {
    first_error.clear();
    TIFFSetErrorHandler(keep_error);
    TIFFSetWarningHandler(nullptr);
    const int descriptor = memory_descriptor();
    if (write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        throw std::bad_alloc();
    lseek(descriptor, 0, SEEK_SET);
    // The library closes the descriptor, but for a file that it does not open.
    TiffFile file{TIFFFdOpen(descriptor, "", "r")};
    if (file) return file;
    close(descriptor);
    refuse_broken_tiff();
}

/// Grey or RGB, with alpha if the file has it.
unsigned tiff_channels(const TiffFile& file) {
    std::uint16_t kind = 0;
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_PHOTOMETRIC, &kind);
    const bool is_grey = kind == PHOTOMETRIC_MINISBLACK || kind == PHOTOMETRIC_MINISWHITE;
    std::uint16_t more = 0;
    std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_EXTRASAMPLES, &more, &kinds);
    return (is_grey ? 1U : 3U) + (more > 0 ? 1U : 0U);
}

}  // namespace

bool is_tiff(std::string_view bytes) {
    using namespace std::string_view_literals;
    // The second two are BigTIFF.
    for (const std::string_view start : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
        if (bytes.starts_with(start)) return true;
    return false;
}

MapImage read_tiff(std::string_view bytes) {
    const TiffFile file = open_tiff(bytes);
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height);
    check_map_size(width, height);
    std::array<char, 1024> why{};
    if (TIFFRGBAImageOK(file.get(), why.data()) == 0)
        throw std::invalid_argument("is a TIFF that cannot be read (" + printable(why.data()) +
                                    "); save it in 8-bit grey");
    std::vector<std::uint32_t> pixels(std::size_t{width} * height);
    if (TIFFReadRGBAImageOriented(file.get(), width, height, pixels.data(), ORIENTATION_TOPLEFT,
                                  1) == 0) {
        refuse_broken_tiff();
    }
    MapImage image{width, height, tiff_channels(file), 255U, {}};
    std::vector<std::uint8_t> samples;
    samples.reserve(pixels.size() * image.channels);
    const bool has_alpha = image.channels % 2 == 0;
    for (const std::uint32_t pixel : pixels) {
        samples.push_back(static_cast<std::uint8_t>(TIFFGetR(pixel)));
        if (image.channels > 2) samples.push_back(static_cast<std::uint8_t>(TIFFGetG(pixel)));
        if (image.channels > 2) samples.push_back(static_cast<std::uint8_t>(TIFFGetB(pixel)));
        if (has_alpha) samples.push_back(static_cast<std::uint8_t>(TIFFGetA(pixel)));
    }
    image.samples = std::move(samples);
    return image;
}

}  // namespace scipd::sim
