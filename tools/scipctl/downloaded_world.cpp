// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/downloaded_world.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "tools/scipctl/names.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// What a mesh of the control API begins with: "SCM1" (docs/api.md).
constexpr std::uint32_t magic = 0x314D4353;

[[noreturn]] void refuse_mesh(const std::string& hash) {
    throw ControlError(0, "scipd sent a mesh that is none, " + hash +
                              "; are scipctl and scipd of the same version?");
}

template <class Element>
std::vector<Element> take(const std::string& bytes, std::size_t& at, std::size_t count) {
    std::vector<Element> list(count);
    if (count > 0) std::memcpy(list.data(), bytes.data() + at, count * sizeof(Element));
    at += count * sizeof(Element);
    return list;
}

sim::SharedMesh mesh_of(const std::string& bytes, const std::string& hash) {
    constexpr std::size_t head_bytes = 12;
    if (bytes.size() < head_bytes) refuse_mesh(hash);
    std::size_t at = 0;
    const auto head = take<std::uint32_t>(bytes, at, 3);
    const std::size_t body_bytes = sizeof(glm::vec3) * head[1] + sizeof(glm::uvec3) * head[2];
    if (head[0] != magic || bytes.size() != head_bytes + body_bytes) refuse_mesh(hash);
    sim::Mesh mesh;
    mesh.vertices_m = take<glm::vec3>(bytes, at, head[1]);
    mesh.triangles = take<glm::uvec3>(bytes, at, head[2]);
    const auto is_wrong = [&](const glm::uvec3& corners) {
        return std::max({corners.x, corners.y, corners.z}) >= mesh.vertices_m.size();
    };
    if (std::ranges::any_of(mesh.triangles, is_wrong)) refuse_mesh(hash);
    return std::make_shared<const sim::Mesh>(std::move(mesh));
}

glm::dvec3 vector_of(const Json& three) {
    return {three.at(0), three.at(1), three.at(2)};
}

sim::Pose pose_in(const Json& pose) {
    const Json& q = pose.at("q");
    return {vector_of(pose.at("xyz")), {q.at(3), q.at(0), q.at(1), q.at(2)}};
}

std::vector<sim::PlacedMesh> meshes_of(const Json& objects, ControlClient& client) {
    std::vector<sim::PlacedMesh> placed;
    std::map<std::string, sim::SharedMesh> known;
    for (const Json& object : objects) {
        if (!object.at("robot").is_null()) continue;
        const std::string hash = object.at("mesh");
        sim::SharedMesh& mesh = known[hash];
        if (mesh == nullptr) mesh = mesh_of(client.text("/scene/meshes/" + hash), hash);
        placed.push_back({.name = object.at("name"),
                          .material = object.at("material"),
                          .mesh = mesh,
                          .scale = vector_of(object.at("scale")),
                          .world_from_mesh = pose_in(object.at("pose"))});
    }
    return placed;
}

}  // namespace

DownloadedWorld download_world(ControlClient& client) {
    DownloadedWorld world;
    world.name = client.get("/scene").value("name", "");
    const Json document = client.get("/scene/objects");
    world.meshes = meshes_of(document.at("objects"), client);
    for (const Json& material : document.at("materials")) {
        world.looks[material.at("name")] = {material.at("reflectivity"),
                                            material.at("transmission")};
    }
    for (const std::string& robot : robots(client)) {
        const glm::dvec3 at_m = vector_of(client.get(pose_path(robot)).at("xyz"));
        world.robots_m.emplace_back(at_m);
    }
    return world;
}

}  // namespace scipd::tools
