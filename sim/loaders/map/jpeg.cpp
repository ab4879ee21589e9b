// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The only file that knows libjpeg-turbo. stb_image, which reads the other pictures, writes past
// its tables on a faulty JPEG.
#include <memory>
#include <stdexcept>
#include <string>

#include <turbojpeg.h>

#include "sim/loaders/map/map_picture.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

struct Destroy {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<void, Destroy>;

[[noreturn]] void refuse_broken(const Decoder& decoder) {
    throw std::invalid_argument("is a broken JPEG: " + printable(tjGetErrorStr2(decoder.get())));
}

}  // namespace

bool is_jpeg(std::string_view bytes) {
    return bytes.starts_with("\xFF\xD8\xFF");
}

MapImage read_jpeg(std::string_view bytes) {
    const Decoder decoder{tjInitDecompress()};
    if (!decoder) throw std::bad_alloc();
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colours = 0;
    if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling,
                            &colours) != 0) {
        refuse_broken(decoder);
    }
    if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
        throw std::invalid_argument(
            "is a JPEG in CMYK, the colours of a printer; save it in grey or RGB");
    }
    check_map_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
    const bool is_grey = colours == TJCS_GRAY;
    MapImage image{static_cast<std::size_t>(width),
                   static_cast<std::size_t>(height),
                   is_grey ? 1U : 3U,
                   255U,
                   {}};
    std::vector<std::uint8_t> samples(image.width * image.height * image.channels);
    // A warning means that the picture ends early; the rest of it would be grey.
    const int flags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT;
    if (tjDecompress2(decoder.get(), data, bytes.size(), samples.data(), width, 0, height,
                      is_grey ? TJPF_GRAY : TJPF_RGB, flags) != 0) {
        refuse_broken(decoder);
    }
    image.samples = std::move(samples);
    return image;
}

}  // namespace scipd::sim
