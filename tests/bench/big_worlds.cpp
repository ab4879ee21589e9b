// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/bench/big_worlds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::bench {
namespace {

struct Terrain {
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Terrain terrain(int side) {
    Terrain hills;
    const auto corners = static_cast<std::uint32_t>(side + 1);
    for (std::uint32_t y = 0; y < corners; ++y) {
        for (std::uint32_t x = 0; x < corners; ++x) {
            const float east = 0.2F * static_cast<float>(x);
            const float north = 0.2F * static_cast<float>(y);
            hills.vertices.emplace_back(east, north, std::sin(0.7F * east) * std::cos(north));
        }
    }
    for (std::uint32_t y = 0; y + 1 < corners; ++y) {
        for (std::uint32_t x = 0; x + 1 < corners; ++x) {
            const std::uint32_t at = y * corners + x;
            hills.triangles.push_back({at, at + 1, at + corners});
            hills.triangles.push_back({at + 1, at + corners + 1, at + corners});
        }
    }
    return hills;
}

template <typename Value>
void put(std::ostream& out, const Value& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
void put_all(std::ostream& out, const std::vector<Value>& values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

void write_obj(std::ostream& out, const Terrain& hills) {
    for (const auto& v : hills.vertices)
        out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    out << "usemtl grass\n";
    for (const auto& t : hills.triangles)
        out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
}

void write_stl(std::ostream& out, const Terrain& hills) {
    out << std::string(80, ' ');
    put(out, static_cast<std::uint32_t>(hills.triangles.size()));
    for (const auto& t : hills.triangles) {
        put(out, glm::vec3{0.F});
        for (const std::uint32_t corner : t)
            put(out, hills.vertices[corner]);
        put(out, std::uint16_t{0});
    }
}

void write_ply(std::ostream& out, const Terrain& hills) {
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << hills.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
        << hills.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    put_all(out, hills.vertices);
    for (const auto& t : hills.triangles) {
        put(out, std::uint8_t{3});
        put(out, t);
    }
}

void write_dae(std::ostream& out, const Terrain& hills) {
    out << R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count=")"
        << 3 * hills.vertices.size() << "\">";
    for (const auto& v : hills.vertices)
        out << v.x << ' ' << v.y << ' ' << v.z << '\n';
    out << R"(</float_array><technique_common><accessor source="#a" count=")"
        << hills.vertices.size() << R"(" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count=")"
        << hills.triangles.size() << R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)";
    for (const auto& t : hills.triangles)
        out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    out << R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>
<visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

void write_glb(std::ostream& out, const Terrain& hills) {
    const auto vertices = std::to_string(12 * hills.vertices.size());
    const auto triangles = std::to_string(12 * hills.triangles.size());
    const std::size_t size = 12 * (hills.vertices.size() + hills.triangles.size());
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[)"
        R"({"byteLength":)" +
        std::to_string(size) + R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
        vertices + R"(},{"buffer":0,"byteOffset":)" + vertices + R"(,"byteLength":)" + triangles +
        R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
        std::to_string(hills.vertices.size()) +
        R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" +
        std::to_string(3 * hills.triangles.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    out << "glTF";
    put(out, std::uint32_t{2});
    put(out, static_cast<std::uint32_t>(28 + json.size() + size));
    put(out, static_cast<std::uint32_t>(json.size()));
    out << "JSON" << json;
    put(out, static_cast<std::uint32_t>(size));
    out << "BIN" << '\0';
    put_all(out, hills.vertices);
    put_all(out, hills.triangles);
}

constexpr std::uint8_t black = 0;
constexpr std::uint8_t grey = 205;
constexpr std::uint8_t white = 254;

constexpr double cell_m = 0.05;
constexpr double room_m = 6.0;

/// A pixel of the storey, in the storey's own axes, with the origin in its middle.
std::uint8_t clean_pixel(double x_m, double y_m, double half_m) {
    if (std::max(std::abs(x_m), std::abs(y_m)) > half_m) return grey;
    const double across_m = std::remainder(x_m, room_m);
    const double along_m = std::remainder(y_m, room_m);
    const double to_wall_m = 0.5 * room_m;
    // Rooms have walls of 15 cm with a door of 1 m in the middle of each side.
    const auto is_wall = [&](double a_m, double b_m) {
        return std::abs(std::abs(a_m) - to_wall_m) < 0.075 && std::abs(b_m) > 0.5;
    };
    if (is_wall(across_m, along_m) || is_wall(along_m, across_m)) return black;
    // In each room there are a table and a round pillar.
    const bool is_table = std::abs(across_m - 1.5) < 0.4 && std::abs(along_m - 1.2) < 0.8;
    const bool is_pillar = std::hypot(across_m + 1.4, along_m + 1.6) < 0.35;
    return is_table || is_pillar ? black : white;
}

}  // namespace

void write_terrain(const std::filesystem::path& file, int side) {
    const Terrain hills = terrain(side);
    std::ofstream out{file, std::ios::binary};
    const auto kind = file.extension();
    if (kind == ".obj") write_obj(out, hills);
    if (kind == ".stl") write_stl(out, hills);
    if (kind == ".ply") write_ply(out, hills);
    if (kind == ".dae") write_dae(out, hills);
    if (kind == ".glb") write_glb(out, hills);
}

void write_map(const std::filesystem::path& file, int side, Clutter clutter) {
    std::mt19937 rng{7};
    const auto chance = [&rng](double share) {
        return static_cast<double>(rng()) < share * 4294967296.0;
    };
    std::uniform_real_distribution<double> jitter_m{-0.06, 0.06};
    const bool is_noisy = clutter == Clutter::noisy_and_turned;
    const double turn_rad = is_noisy ? 0.12 : 0.0;
    const double half_m = 0.5 * side * cell_m;
    std::string pixels;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double east_m = (column + 0.5) * cell_m - half_m;
            const double north_m = half_m - (row + 0.5) * cell_m;
            // The place where a beam ends that is off by a few centimetres.
            const double x_m = std::cos(turn_rad) * east_m + std::sin(turn_rad) * north_m +
                               (is_noisy ? jitter_m(rng) : 0.0);
            const double y_m = std::cos(turn_rad) * north_m - std::sin(turn_rad) * east_m +
                               (is_noisy ? jitter_m(rng) : 0.0);
            std::uint8_t pixel = clean_pixel(x_m, y_m, 0.85 * half_m);
            if (is_noisy && chance(0.001)) pixel = black;
            if (is_noisy && chance(0.002)) pixel = grey;
            pixels.push_back(static_cast<char>(pixel));
        }
    }
    auto picture = file;
    picture.replace_extension(".pgm");
    const std::string size = std::to_string(side);
    std::ofstream{picture, std::ios::binary} << "P5\n"
                                             << size << ' ' << size << "\n255\n"
                                             << pixels;
    std::ofstream{file} << "image: " << picture.filename().string() << "\nresolution: " << cell_m
                        << "\norigin: [-100, -100, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
                           "free_thresh: 0.196\n";
}

}  // namespace scipd::bench
