// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads PGM by hand: stb_image reads neither plain PGM, which people write for tests, nor a maxval
// below 255.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "sim/loaders/map/map_picture.h"

namespace scipd::sim {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

bool is_blank(char c) {
    return blanks.find(c) != blanks.npos;
}

/// The rest of the file that is still to be read.
class Reader {
  public:
    explicit Reader(std::string_view rest) : rest_(rest) {}

    /// The next number, past blanks and comments.
    unsigned number(const char* what) {
        skip_blanks();
        unsigned value = 0;
        std::size_t digits = 0;
        for (; digits < rest_.size() && rest_[digits] >= '0' && rest_[digits] <= '9'; ++digits) {
            if (digits == 9) refuse(what);
            value = 10 * value + static_cast<unsigned>(rest_[digits] - '0');
        }
        if (digits == 0) refuse(what);
        rest_.remove_prefix(digits);
        return value;
    }

    /// Exactly one blank separates the header from raw samples.
    std::string_view raw() {
        if (rest_.empty() || !is_blank(rest_.front())) refuse("a blank after maxval");
        return rest_.substr(1);
    }

    [[nodiscard]] std::size_t size() const { return rest_.size(); }

  private:
    void skip_blanks() {
        while (!rest_.empty()) {
            if (rest_.front() == '#') {
                rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
            } else if (is_blank(rest_.front())) {
                rest_.remove_prefix(1);
            } else {
                return;
            }
        }
    }

    [[noreturn]] static void refuse(const std::string& what) {
        throw std::invalid_argument("is a broken PGM: " + what + " is missing");
    }

    std::string_view rest_;
};

void check_length(std::size_t there, std::size_t wanted) {
    if (there >= wanted) return;
    throw std::invalid_argument("is a broken PGM: it ends " + std::to_string(wanted - there) +
                                " bytes too early");
}

/// Samples above white become white.
template <typename Sample>
std::vector<Sample> plain_samples(Reader& reader, std::size_t count, unsigned white) {
    // Each sample has a digit and a blank at least. Check that before allocating memory for them.
    check_length(reader.size() + 1, 2 * count);
    std::vector<Sample> samples(count);
    for (Sample& sample : samples)
        sample = static_cast<Sample>(std::min(reader.number("a pixel"), white));
    return samples;
}

std::vector<std::uint8_t> bytes_of(std::string_view raw, std::size_t count, unsigned white) {
    check_length(raw.size(), count);
    std::vector<std::uint8_t> samples(count);
    std::transform(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(count), samples.begin(),
                   [white](char c) {
                       return std::min(static_cast<std::uint8_t>(c),
                                       static_cast<std::uint8_t>(white));
                   });
    return samples;
}

/// The more significant byte first.
std::vector<std::uint16_t> words_of(std::string_view raw, std::size_t count, unsigned white) {
    check_length(raw.size(), 2 * count);
    std::vector<std::uint16_t> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto high = static_cast<std::uint8_t>(raw[2 * i]);
        const auto low = static_cast<std::uint8_t>(raw[2 * i + 1]);
        samples[i] = static_cast<std::uint16_t>(std::min(256U * high + low, white));
    }
    return samples;
}

}  // namespace

bool is_pgm(std::string_view bytes) {
    return bytes.starts_with("P2") || bytes.starts_with("P5");
}

MapImage read_pgm(std::string_view bytes) {
    Reader reader{bytes.substr(2)};
    MapImage image;
    image.width = reader.number("the width");
    image.height = reader.number("the height");
    image.white = reader.number("maxval");
    if (image.white == 0 || image.white > 65535) {
        throw std::invalid_argument("is a broken PGM: maxval must be within 1 and 65535");
    }
    check_map_size(image.width, image.height);
    const std::size_t count = image.width * image.height;
    const bool is_plain = bytes[1] == '2';
    if (image.white < 256) {
        image.samples = is_plain ? plain_samples<std::uint8_t>(reader, count, image.white)
                                 : bytes_of(reader.raw(), count, image.white);
    } else {
        image.samples = is_plain ? plain_samples<std::uint16_t>(reader, count, image.white)
                                 : words_of(reader.raw(), count, image.white);
    }
    return image;
}

}  // namespace scipd::sim
