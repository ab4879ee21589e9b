// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a page gets to draw: read as a page reads it, against the closed forms of the shapes.
#include "daemon/api/scene_objects.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/routes.h"
#include "tests/support/empty_api.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;

struct Triangles {
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> indices;
};

template <class Value>
Value take(std::string_view& bytes) {
    Value value;
    EXPECT_GE(bytes.size(), sizeof(Value));
    std::memcpy(&value, bytes.data(), sizeof(Value));
    bytes.remove_prefix(sizeof(Value));
    return value;
}

Triangles read(std::string_view bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "SCM1");
    bytes.remove_prefix(4);
    Triangles triangles;
    triangles.vertices.resize(take<std::uint32_t>(bytes));
    triangles.indices.resize(take<std::uint32_t>(bytes));
    EXPECT_EQ(bytes.size(), 12 * (triangles.vertices.size() + triangles.indices.size()));
    for (glm::vec3& vertex : triangles.vertices)
        vertex = take<glm::vec3>(bytes);
    for (glm::uvec3& index : triangles.indices)
        index = take<glm::uvec3>(bytes);
    return triangles;
}

double area_m2(const Triangles& triangles, const glm::dvec3& scale) {
    double area = 0.0;
    for (const glm::uvec3& corner : triangles.indices) {
        const auto at = [&](unsigned i) { return glm::dvec3(triangles.vertices.at(i)) * scale; };
        area +=
            0.5 * glm::length(glm::cross(at(corner.y) - at(corner.x), at(corner.z) - at(corner.x)));
    }
    return area;
}

class DrawnWorld : public tests::EmptyApi {
  public:
    explicit DrawnWorld(sim::SharedScene scene) : scene_(std::move(scene)) {}
    [[nodiscard]] SceneView scene() const override { return {"/scenes/room.sdf", scene_}; }

    HttpResponse get(const std::string& path) {
        std::optional<HttpResponse> answer;
        route(*this, {"GET", path, "", ""}, [&](HttpResponse now) { answer = std::move(now); });
        return answer.value();
    }
    json object(std::size_t id) { return json::parse(get("/scene/objects").body)["objects"][id]; }
    double area_of(std::size_t id) {
        const json said = object(id);
        const auto bytes = get("/scene/meshes/" + std::string(said["mesh"])).body;
        const auto scale = said["scale"];
        return area_m2(read(bytes), {scale[0], scale[1], scale[2]});
    }

    sim::SharedScene scene_;
};

const sim::SharedMesh triangle =
    std::make_shared<const sim::Mesh>(sim::Mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});

TEST(SceneObjects, AreTheShapesThatAreCast) {
    DrawnWorld world(sim::SceneBuilder()
                         .add(sim::Box{{1, 2, 3}}, {})
                         .add(sim::Plane{{200, 5}}, {})
                         .add(sim::Sphere{0.5}, {})
                         .add(sim::Cylinder{0.25, 2.0}, {})
                         .add(triangle, {})
                         .build());
    constexpr double pi = std::numbers::pi;
    EXPECT_NEAR(world.area_of(0), 2 * (1 * 2 + 2 * 3 + 3 * 1), 1e-5);
    EXPECT_NEAR(world.area_of(1), 1000, 1e-3);
    EXPECT_NEAR(world.area_of(2), 4 * pi * 0.25, 0.02);
    EXPECT_NEAR(world.area_of(3), 2 * pi * 0.25 * 2.0 + 2 * pi * 0.0625, 0.02);
    EXPECT_NEAR(world.area_of(4), 6, 1e-6);
}

TEST(SceneObjects, OfTheSameGeometryShareTheirTriangles) {
    const auto copy = std::make_shared<const sim::Mesh>(*triangle);
    const auto other = std::make_shared<const sim::Mesh>(
        sim::Mesh{{{0, 0, 0}, {3, 0, 0}, {0, 5, 0}}, {{0, 1, 2}}});
    DrawnWorld world(sim::SceneBuilder()
                         .add(sim::Box{{1, 2, 3}}, {})
                         .add(sim::Box{{4, 5, 6}}, {})
                         .add(sim::Sphere{1}, {})
                         .add(sim::Sphere{2}, {})
                         .add(triangle, {})
                         .add(copy, {})
                         .add(other, {})
                         .build());
    const auto hash = [&](std::size_t id) { return std::string(world.object(id)["mesh"]); };
    EXPECT_GE(hash(0).size(), 16U);
    EXPECT_EQ(hash(0), hash(1));
    EXPECT_NE(hash(2), hash(3));
    EXPECT_EQ(hash(4), hash(5));
    EXPECT_NE(hash(4), hash(6));
    DrawnWorld later(sim::SceneBuilder().add(other, {}).build());
    EXPECT_EQ(later.object(0)["mesh"], hash(6)) << "a browser keeps it from world to world";
}

TEST(SceneObjects, AreToldWithWhereTheyAre) {
    DrawnWorld world(sim::SceneBuilder()
                         .movable({{1, 2, 3}, {0, 0, 0, 1}})
                         .with(sim::Box{{1, 1, 1}}, {{0.5, 0, 0}, {1, 0, 0, 0}}, 1)
                         .build());
    const json said = json::parse(world.get("/scene/objects").body);
    EXPECT_EQ(said["version"], "1");
    EXPECT_EQ(said["limits"]["http_body_bytes"], 1000);
    const json object = said["objects"][0];
    EXPECT_EQ(object["id"], 0);
    EXPECT_EQ(object["model"], "model 0");
    EXPECT_EQ(object["movable"], true);
    EXPECT_EQ(object["robot"], nullptr);
    EXPECT_EQ(object["material"], "material 1");
    EXPECT_EQ(object["in_model"]["xyz"], json({0.5, 0.0, 0.0}));
    EXPECT_EQ(object["pose"]["xyz"], json({0.5, 2.0, 3.0})) << "turned by half a turn about z";
    EXPECT_EQ(said["materials"][1]["name"], "material 1");
    EXPECT_EQ(said["materials"][1]["known"], false);
    EXPECT_NEAR(said["materials"][1]["reflectivity"], 0.9, 1e-6);
}

TEST(SceneObjects, AreKeptByTheBrowser) {
    DrawnWorld world(sim::SceneBuilder().add(triangle, {}).build());
    const auto response = world.get("/scene/meshes/" + std::string(world.object(0)["mesh"]));
    EXPECT_EQ(response.content_type, "application/octet-stream");
    EXPECT_THAT(response.headers,
                testing::Contains(testing::Pair("Cache-Control", testing::HasSubstr("immutable"))));
    EXPECT_EQ(world.get("/scene/meshes/0123456789abcdef").status, 404);
}

TEST(SceneObjects, DoNotKeepTheirScene) {
    auto scene = sim::SceneBuilder().add(triangle, {}).build();
    const std::string hash = DrawnWorld(scene).object(0)["mesh"];
    const SceneObjects objects(scene);
    EXPECT_TRUE(objects.triangles(hash));
    scene.reset();
    EXPECT_FALSE(objects.triangles(hash));
}

}  // namespace
}  // namespace scipd::daemon
