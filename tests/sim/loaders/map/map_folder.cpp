// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/sim/loaders/map/map_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <glm/geometric.hpp>
#include <stb/stb_image_write.h>

namespace scipd::sim {
namespace {

std::string bytes_of(const std::vector<int>& samples) {
    std::string bytes;
    for (const int sample : samples)
        bytes.push_back(static_cast<char>(sample));
    return bytes;
}

std::string big_endian(unsigned value) {
    std::string bytes;
    for (const unsigned shift : {24U, 16U, 8U, 0U})
        bytes.push_back(static_cast<char>(value >> shift & 0xFFU));
    return bytes;
}

/// Without a true check sum: stb_image does not look at it.
std::string chunk(const std::string& kind, const std::string& data) {
    return big_endian(static_cast<unsigned>(data.size())) + kind + data + "sum?";
}

}  // namespace

std::string pgm(std::size_t width, const std::vector<int>& greys) {
    return "P5\n" + std::to_string(width) + ' ' + std::to_string(greys.size() / width) + "\n255\n" +
           bytes_of(greys);
}

std::string png(std::size_t width, int channels, const std::vector<int>& samples) {
    const std::string bytes = bytes_of(samples);
    const std::size_t stride = width * static_cast<std::size_t>(channels);
    std::string out;
    stbi_write_png_to_func(
        [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<char*>(data),
                                                  static_cast<std::size_t>(size));
        },
        &out, static_cast<int>(width), static_cast<int>(bytes.size() / stride), channels,
        bytes.data(), static_cast<int>(stride));
    return out;
}

std::string odd_png(unsigned width, unsigned height, unsigned depth, unsigned colour,
                    const std::string& rows) {
    std::string raw = rows;
    int size = 0;
    unsigned char* deflated = stbi_zlib_compress(reinterpret_cast<unsigned char*>(raw.data()),
                                                 static_cast<int>(raw.size()), &size, 8);
    const std::string data(reinterpret_cast<char*>(deflated), static_cast<std::size_t>(size));
    std::free(deflated);
    const std::string kind{static_cast<char>(depth), static_cast<char>(colour), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big_endian(width) + big_endian(height) + kind) +
           chunk("IDAT", data) + chunk("IEND", "");
}

std::string bmp(int width, int height, const std::vector<int>& greys) {
    const auto little_endian = [](unsigned value) {
        const std::string bytes = big_endian(value);
        return std::string(bytes.rbegin(), bytes.rend());
    };
    std::string rows;
    for (int row = 0; row < std::abs(height); ++row) {
        const int from_top = height < 0 ? row : height - 1 - row;
        for (int column = 0; column < width; ++column) {
            const int grey = greys[static_cast<std::size_t>(from_top * width + column)];
            rows += std::string(3, static_cast<char>(grey));
        }
        rows.resize((rows.size() + 3) / 4 * 4);
    }
    return "BM" + little_endian(static_cast<unsigned>(54 + rows.size())) + little_endian(0) +
           little_endian(54) + little_endian(40) + little_endian(static_cast<unsigned>(width)) +
           little_endian(static_cast<unsigned>(height)) + std::string{1, 0, 24, 0} +
           std::string(24, '\0') + rows;
}

std::string tiff(unsigned width, unsigned channels, const std::vector<int>& samples,
                 const std::vector<std::pair<int, int>>& tags) {
    const auto number = [](std::uint64_t value, int bytes) {
        std::string text;
        for (int i = 0; i < bytes; ++i)
            text += static_cast<char>(value >> (8 * i));
        return text;
    };
    // Bits, and where the strips begin and how long they are, lie behind the pixels.
    const unsigned row = width * channels;
    const auto rows = static_cast<unsigned>(samples.size()) / row;
    constexpr unsigned first = 8;
    const unsigned bits_at = first + row * rows;
    const unsigned starts_at = bits_at + 2 * 4;
    const unsigned sizes_at = starts_at + 4 * rows;
    std::string pixels;
    for (const int sample : samples)
        pixels += static_cast<char>(sample);
    for (unsigned i = 0; i < 4; ++i)
        pixels += number(8, 2);
    for (unsigned i = 0; i < rows; ++i)
        pixels += number(first + i * row, 4);
    for (unsigned i = 0; i < rows; ++i)
        pixels += number(row, 4);
    constexpr int of_16_bits = 3;
    constexpr int of_32_bits = 4;
    std::map<int, std::string> entries;
    const auto add = [&](int tag, int type, unsigned count, unsigned value) {
        entries[tag] = number(tag, 2) + number(type, 2) + number(count, 4) + number(value, 4);
    };
    add(256, of_32_bits, 1, width);
    add(257, of_32_bits, 1, rows);
    add(258, of_16_bits, channels, channels == 1 ? 8 : channels == 2 ? 8 | 8U << 16U : bits_at);
    add(259, of_16_bits, 1, 1);  // no compression
    add(273, of_32_bits, rows, rows == 1 ? first : starts_at);
    add(277, of_16_bits, 1, channels);
    add(278, of_32_bits, 1, 1);  // rows of a strip
    add(279, of_32_bits, rows, rows == 1 ? row : sizes_at);
    for (const auto& [tag, value] : tags)
        add(tag, of_16_bits, 1, static_cast<unsigned>(value));
    std::string directory = number(entries.size(), 2);
    for (const auto& [tag, entry] : entries)
        directory += entry;
    return "II*" + std::string(1, '\0') + number(first + pixels.size(), 4) + pixels + directory +
           number(0, 4);
}

std::string jpeg(int width, const std::vector<int>& greys) {
    const std::string bytes = bytes_of(greys);
    std::string out;
    stbi_write_jpg_to_func(
        [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<char*>(data),
                                                  static_cast<std::size_t>(size));
        },
        &out, width, static_cast<int>(bytes.size()) / width, 1, bytes.data(), 100);
    return out;
}

std::string yaml(const std::string& image, const std::string& more) {
    return "image: " + image + "\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n" + more +
           (more.find("occupied_thresh") == more.npos ? "occupied_thresh: 0.65\n" : "") +
           (more.find("free_thresh") == more.npos ? "free_thresh: 0.196\n" : "");
}

LoadedScene MapFolder::load(const std::string& image, const std::string& picture,
                            const std::string& text, const MapOptions& options) {
    folder_.write(image, picture);
    return load_ros_map(folder_.write("map.yaml", text), options);
}

Hit Probe::cast(const glm::dvec3& from_m, const glm::dvec3& direction) {
    // The direction as a turn of the sensor: a fan's own directions are float.
    const glm::dvec3 to = glm::normalize(direction);
    const glm::dvec3 across = glm::cross(glm::dvec3{1.0, 0.0, 0.0}, to);
    const glm::dquat turn = glm::dot(glm::dvec3{1.0, 0.0, 0.0}, to) < -0.999999
                                ? glm::dquat{0.0, 0.0, 0.0, 1.0}
                                : glm::normalize(glm::dquat{1.0 + to.x, across});
    const Pose world_from_sensor{from_m, turn};
    const glm::vec3 ahead{1.F, 0.F, 0.F};
    Hit hit;
    backend_->cast({.directions = {&ahead, 1}, .world_from_sensor = {&world_from_sensor, 1}},
                   {&hit, 1});
    return hit;
}

float Probe::top_m(double x_m, double y_m) {
    const Hit hit = cast({x_m, y_m, 100.0}, {0.0, 0.0, -1.0});
    return hit.met() ? 100.F - hit.range_m : -1.F;
}

std::string Probe::row(std::size_t cells) {
    std::string row;
    for (std::size_t i = 0; i < cells; ++i)
        row += top_m(static_cast<double>(i) + 0.5, 0.5) > 0.F ? '#' : '.';
    return row;
}

}  // namespace scipd::sim
