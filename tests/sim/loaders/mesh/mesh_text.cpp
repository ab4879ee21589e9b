// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/sim/loaders/mesh/mesh_text.h"

#include <cstdint>
#include <cstring>
#include <sstream>

#include <glm/common.hpp>

namespace scipd::sim {
namespace {

template <typename Value>
void put(std::string& bytes, const Value& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

Triangles all_triangles() {
    Triangles all = oak_triangles();
    all.insert(all.end(), steel_triangles().begin(), steel_triangles().end());
    return all;
}

template <typename Each>
std::string each_of(const Triangles& triangles, const Each& each) {
    std::ostringstream text;
    for (const auto& triangle : triangles)
        each(text, triangle);
    return text.str();
}

std::string xyz_lines(const Corners& corners, const char* prefix = "") {
    std::ostringstream text;
    for (const auto& at : corners)
        text << prefix << at.x << ' ' << at.y << ' ' << at.z << '\n';
    return text.str();
}

std::string ply_header(const Corners& corners, const char* format) {
    return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " +
           std::to_string(corners.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(all_triangles().size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string base64(const std::string& bytes) {
    constexpr auto digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool is_there = i + k < bytes.size();
            three = three << 8U | (is_there ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool is_there = i + k < bytes.size() + 1;
            text.push_back(is_there ? digits[three >> (18U - 6U * k) & 63U] : '=');
        }
    }
    return text;
}

std::string gltf_buffer(const Corners& corners) {
    std::string bytes;
    for (const auto& at : corners)
        put(bytes, at);
    for (const auto& triangle : all_triangles()) {
        for (const unsigned corner : triangle)
            put(bytes, static_cast<std::uint16_t>(corner));
    }
    return bytes;
}

/// `buffer` begins the entry of the only buffer.
std::string gltf_json(const Corners& corners, const std::string& buffer, bool has_materials) {
    glm::vec3 low = corners.front();
    glm::vec3 high = low;
    for (const auto& at : corners) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const std::size_t positions = corners.size() * sizeof(glm::vec3);
    const std::size_t oak = 6 * oak_triangles().size();
    const std::size_t steel = 6 * steel_triangles().size();
    const auto primitive = [&](int indices, int material) {
        return R"({"attributes":{"POSITION":0},"indices":)" + std::to_string(indices) +
               (has_materials ? R"(,"material":)" + std::to_string(material) : std::string{}) + "}";
    };
    const auto view = [](std::size_t offset, std::size_t length) {
        return R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
               std::to_string(length) + "}";
    };
    const auto indices = [](int of, std::size_t length) {
        return R"(,{"bufferView":)" + std::to_string(of) +
               R"(,"componentType":5123,"type":"SCALAR","count":)" + std::to_string(length / 2) +
               "}";
    };
    std::ostringstream text;
    text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         << R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" << primitive(1, 0) << ','
         << primitive(2, 1) << R"(]}],)";
    if (has_materials) text << R"("materials":[{"name":"oak"},{"name":"steel"}],)";
    text << R"("buffers":[{)" << buffer << R"("byteLength":)" << positions + oak + steel
         << R"(}],"bufferViews":[)" << view(0, positions) << ',' << view(positions, oak) << ','
         << view(positions + oak, steel)
         << R"(],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)"
         << corners.size() << R"(,"min":[)" << low.x << ',' << low.y << ',' << low.z
         << R"(],"max":[)" << high.x << ',' << high.y << ',' << high.z << "]}" << indices(1, oak)
         << indices(2, steel) << "]}";
    return text.str();
}

std::string dae_triangles(const Triangles& triangles, const std::string& material) {
    const auto p = each_of(triangles, [](auto& text, const auto& t) {
        text << t[0] << ' ' << t[1] << ' ' << t[2] << ' ';
    });
    return "<triangles count=\"" + std::to_string(triangles.size()) + "\"" +
           (material.empty() ? "" : " material=\"of_" + material + "\"") +
           "><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + p + "</p></triangles>\n";
}

std::string dae(const Corners& corners, std::string_view asset, bool has_materials) {
    std::string materials;
    std::string bindings;
    for (const std::string name : {"oak", "steel"}) {
        materials += "<material id=\"m_" + name + "\" name=\"" + name +
                     "\"><instance_effect url=\"#e\"/></material>";
        bindings += "<instance_material symbol=\"of_" + name + "\" target=\"#m_" + name + "\"/>";
    }
    std::ostringstream text;
    text << "<?xml version=\"1.0\"?>\n<COLLADA "
            "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n<asset>"
         << asset << "</asset>\n<library_effects><effect id=\"e\"><profile_COMMON><technique "
         << "sid=\"t\"><lambert/></technique></profile_COMMON></effect></library_effects>\n";
    if (has_materials) text << "<library_materials>" << materials << "</library_materials>\n";
    text << "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" "
            "count=\""
         << 3 * corners.size() << "\">" << xyz_lines(corners)
         << "</float_array><technique_common><accessor source=\"#a\" count=\"" << corners.size()
         << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
            "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
            "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n"
         << dae_triangles(oak_triangles(), has_materials ? "oak" : "")
         << dae_triangles(steel_triangles(), has_materials ? "steel" : "")
         << "</mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene "
            "id=\"s\"><node><instance_geometry url=\"#g\">";
    if (has_materials) {
        text << "<bind_material><technique_common>" << bindings
             << "</technique_common></bind_material>";
    }
    text << "</instance_geometry></node></visual_scene></library_visual_scenes>\n"
            "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
    return text.str();
}

}  // namespace

// Corner k: bit 0 is +x, bit 1 +y, bit 2 +z.
const Triangles& oak_triangles() {
    static const Triangles triangles{{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3},
                                     {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return triangles;
}

const Triangles& steel_triangles() {
    static const Triangles triangles{{4, 5, 6}, {5, 7, 6}};
    return triangles;
}

std::vector<glm::vec3> corners_of(const Solid& solid, const glm::mat3& file_from_solid) {
    std::vector<glm::vec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        corners.push_back(file_from_solid * glm::vec3{k & 1U ? solid.high_m.x : solid.low_m.x,
                                                      k & 2U ? solid.high_m.y : solid.low_m.y,
                                                      k & 4U ? solid.high_m.z : solid.low_m.z});
    }
    return corners;
}

std::string obj_text(const Corners& corners, std::string_view mtl) {
    const auto face = [](auto& text, const auto& t) {
        text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    };
    return (mtl.empty() ? "" : "mtllib " + std::string(mtl) + "\n") + xyz_lines(corners, "v ") +
           "usemtl oak\n" + each_of(oak_triangles(), face) + "usemtl steel\n" +
           each_of(steel_triangles(), face);
}

std::string mtl_text() {
    return "newmtl oak\nKd 0.5 0.3 0.1\nnewmtl steel\nKd 0.7 0.7 0.7\n";
}

std::string stl_text(const Corners& corners) {
    return "solid box\n" +
           each_of(all_triangles(),
                   [&](auto& text, const auto& t) {
                       text << "facet normal 0 0 0\nouter loop\n"
                            << xyz_lines({corners[t[0]], corners[t[1]], corners[t[2]]}, "vertex ")
                            << "endloop\nendfacet\n";
                   }) +
           "endsolid box\n";
}

std::string stl_bytes(const Corners& corners) {
    std::string bytes(80, ' ');
    put(bytes, static_cast<std::uint32_t>(all_triangles().size()));
    for (const auto& triangle : all_triangles()) {
        put(bytes, glm::vec3{0.F});
        for (const unsigned corner : triangle)
            put(bytes, corners[corner]);
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string ply_text(const Corners& corners) {
    return ply_header(corners, "ascii") + xyz_lines(corners) +
           each_of(all_triangles(), [](auto& text, const auto& t) {
               text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
           });
}

std::string ply_bytes(const Corners& corners) {
    std::string bytes = ply_header(corners, "binary_little_endian");
    for (const auto& at : corners)
        put(bytes, at);
    for (const auto& triangle : all_triangles()) {
        put(bytes, std::uint8_t{3});
        for (const unsigned corner : triangle)
            put(bytes, corner);
    }
    return bytes;
}

std::string dae_text(const Corners& corners, std::string_view asset) {
    return dae(corners, asset, true);
}

std::string plain_dae_text(const Corners& corners) {
    return dae(corners, "<up_axis>Z_UP</up_axis>", false);
}

std::string gltf_text(const Corners& corners) {
    return gltf_json(
        corners,
        R"("uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer(corners)) + R"(",)",
        true);
}

std::string plain_gltf_text(const Corners& corners) {
    return gltf_json(
        corners,
        R"("uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer(corners)) + R"(",)",
        false);
}

std::string glb_bytes(const Corners& corners) {
    std::string json = gltf_json(corners, "", true);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string buffer = gltf_buffer(corners);
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    put(bytes, std::uint32_t{2});
    put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<std::uint32_t>(buffer.size()));
    return bytes + std::string("BIN\0", 4) + buffer;
}

}  // namespace scipd::sim
