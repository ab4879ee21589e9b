// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every mesh format gives the same ranges for the same solid: those of the closed form.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/mesh/mesh_parts.h"
#include "sim/loaders/model/model_fragment.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/map/map_folder.h"
#include "tests/sim/loaders/mesh/mesh_text.h"
#include "tests/sim/loaders/mesh/whole_mesh.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const glm::mat3 as_it_is{1.F};
/// Columns are where x, y and z of the solid go.
const glm::mat3 y_up_from_z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
const glm::mat3 x_up_from_z_up{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}};

struct Format {
    const char* title;
    const char* file;
    glm::mat3 file_from_solid;
    std::string (*write)(const Corners& corners);
    bool names_materials;
};

/// Every format with every convention that it has for units and axes.
std::vector<Format> formats() {
    return {
        {"obj", "a.obj", as_it_is, [](const Corners& c) { return obj_text(c, ""); }, true},
        {"obj_mtl", "a.OBJ", as_it_is, [](const Corners& c) { return obj_text(c, "a.mtl"); }, true},
        {"stl_ascii", "a.stl", as_it_is, stl_text, false},
        {"stl_binary", "a.STL", as_it_is, stl_bytes, false},
        {"ply_ascii", "a.ply", as_it_is, ply_text, false},
        {"ply_binary", "a.ply", as_it_is, ply_bytes, false},
        {"dae_z_up", "a.dae", as_it_is,
         [](const Corners& c) { return dae_text(c, "<up_axis>Z_UP</up_axis>"); }, true},
        {"dae_y_up_in_centimetres", "a.dae", 100.F * y_up_from_z_up,
         [](const Corners& c) {
             return dae_text(c, "<unit name='cm' meter='0.01'/><up_axis>Y_UP</up_axis>");
         },
         true},
        {"dae_that_says_nothing", "a.dae", y_up_from_z_up,
         [](const Corners& c) { return dae_text(c, ""); }, true},
        {"gltf", "a.gltf", y_up_from_z_up, gltf_text, true},
        {"glb", "a.glb", y_up_from_z_up, glb_bytes, true},
    };
}

/// How far along a ray a box begins, by its slabs; infinity where it is missed.
double closed_form_m(const Solid& solid, const glm::dvec3& from_m, const glm::dvec3& direction) {
    double enter_m = 0.0;
    double leave_m = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low_m = (solid.low_m[axis] - from_m[axis]) / direction[axis];
        const double high_m = (solid.high_m[axis] - from_m[axis]) / direction[axis];
        enter_m = std::max(enter_m, std::min(low_m, high_m));
        leave_m = std::min(leave_m, std::max(low_m, high_m));
    }
    return enter_m <= leave_m ? enter_m : std::numeric_limits<double>::infinity();
}

/// From all around towards the box and past it.
template <typename Check>
void cast_at(const Solid& solid, Probe& probe, const Check& check) {
    std::mt19937 rng{3};
    std::normal_distribution<double> normal;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 out = glm::normalize(glm::dvec3{normal(rng), normal(rng), normal(rng)});
        const glm::dvec3 middle_m = 0.5 * glm::dvec3{solid.low_m + solid.high_m};
        const glm::dvec3 from_m = middle_m + 8.0 * out;
        const glm::dvec3 aside{normal(rng), normal(rng), normal(rng)};
        const glm::dvec3 direction = glm::normalize(middle_m + aside - from_m);
        const double expected_m = closed_form_m(solid, from_m, direction);
        // Along an edge either answer is right.
        const Solid smaller{solid.low_m + 1e-3F, solid.high_m - 1e-3F};
        const Solid larger{solid.low_m - 1e-3F, solid.high_m + 1e-3F};
        if (std::isinf(closed_form_m(smaller, from_m, direction)) !=
            std::isinf(closed_form_m(larger, from_m, direction))) {
            continue;
        }
        const Hit hit = probe.cast(from_m, direction);
        ASSERT_EQ(hit.met(), std::isfinite(expected_m));
        if (hit.met()) check(hit, expected_m, from_m + expected_m * direction);
    }
}

class MeshFormats : public testing::TestWithParam<Format> {
  protected:
    std::filesystem::path write() {
        folder_.write("a.mtl", mtl_text());
        return folder_.write(GetParam().file,
                             GetParam().write(corners_of(solid_, GetParam().file_from_solid)));
    }

    Solid solid_;
    TempDir folder_;
};

TEST_P(MeshFormats, asAWorldHaveTheRangesOfTheClosedForm) {
    const auto loaded = load_scene(write());
    EXPECT_THAT(loaded.warnings, testing::IsEmpty());
    const Scene& scene = *loaded.scene;
    EXPECT_EQ(scene.name, "a");
    ASSERT_EQ(scene.models.size(), 1U);
    EXPECT_FALSE(scene.models[0].movable);
    Probe probe{loaded.scene};
    int hits = 0;
    cast_at(solid_, probe, [&](const Hit& hit, double expected_m, const glm::dvec3& at_m) {
        ASSERT_NEAR(hit.range_m, expected_m, 2e-6 * 8);
        const std::string& material = scene.materials[hit.material].name;
        const bool on_top = std::abs(at_m.z - solid_.high_m.z) < 1e-9;
        if (!GetParam().names_materials) {
            ASSERT_EQ(material, "default");
        } else if (std::abs(at_m.z - solid_.high_m.z) > 1e-3 || on_top) {
            ASSERT_EQ(material, on_top ? "steel" : "oak");
        }
        ++hits;
    });
    EXPECT_GT(hits, 200);
}

TEST_P(MeshFormats, asAModelThatIsAddedStandTheSame) {
    const auto loaded = load_mesh_model(write(), {"thing"});
    Probe probe{loaded.scene};
    int hits = 0;
    cast_at(solid_, probe, [&](const Hit& hit, double expected_m, const glm::dvec3&) {
        ASSERT_NEAR(hit.range_m, expected_m, 2e-6 * 8);
        ++hits;
    });
    EXPECT_GT(hits, 200);
}

TEST_P(MeshFormats, inAnSdfWorldKeepTheirAxesAsInGazebo) {
    write();
    const auto file =
        folder_.write("world.sdf", world(model_of(visual("v", mesh_of(GetParam().file)))));
    const auto scene = load_scene(file).scene;
    // Turned by the SDF, as people do it for Gazebo: by 90 degrees about x, where y is up.
    const float unit = std::abs(glm::dot(GetParam().file_from_solid[0], glm::vec3{1.F}));
    const glm::mat3 turn = GetParam().file_from_solid / unit;
    const Solid lying{glm::min(turn * solid_.low_m, turn * solid_.high_m),
                      glm::max(turn * solid_.low_m, turn * solid_.high_m)};
    Probe probe{scene};
    int hits = 0;
    cast_at(lying, probe, [&](const Hit& hit, double expected_m, const glm::dvec3&) {
        ASSERT_NEAR(hit.range_m, expected_m, 2e-6 * 8);
        ++hits;
    });
    EXPECT_GT(hits, 200);
    std::vector<std::string> names;
    for (const auto& material : scene->materials)
        names.push_back(material.name);
    if (GetParam().names_materials) {
        EXPECT_THAT(names, testing::UnorderedElementsAre("default", "oak", "steel"));
    } else {
        EXPECT_THAT(names, ElementsAre("default"));
    }
}

INSTANTIATE_TEST_SUITE_P(Of, MeshFormats, testing::ValuesIn(formats()),
                         [](const auto& format) { return std::string(format.param.title); });

TEST(MeshFormat, colladaThatHasXUpIsTurned) {
    const TempDir folder;
    const Solid solid;
    const auto file = folder.write(
        "a.dae", dae_text(corners_of(solid, x_up_from_z_up), "<up_axis>X_UP</up_axis>"));
    Probe probe{load_scene(file).scene};
    cast_at(solid, probe, [&](const Hit& hit, double expected_m, const glm::dvec3&) {
        ASSERT_NEAR(hit.range_m, expected_m, 2e-6 * 8);
    });
}

/// Transforms that a careless reader takes for none, and one that no reader does.
std::vector<glm::dmat4> small_transforms() {
    const glm::dmat4 none{1.0};
    const glm::dmat4 turn = glm::rotate(none, glm::radians(0.5), {0.0, 0.0, 1.0});
    const glm::dmat4 move = glm::translate(none, {0.009, 0.0, -0.004});
    const glm::dmat4 grow = glm::scale(none, glm::dvec3{1.009});
    return {turn, move, grow, turn * move * grow, glm::scale(none, {-1.0, 1.0, 1.0}) * turn};
}

/// Row after row as in COLLADA, or column after column as in glTF.
std::string numbers_of(const glm::dmat4& matrix, bool by_rows, char between) {
    std::ostringstream text;
    text.precision(9);
    for (int i = 0; i < 16; ++i) {
        const double number = by_rows ? matrix[i % 4][i / 4] : matrix[i / 4][i % 4];
        if (i > 0) text << between;
        text << number;
    }
    return text.str();
}

std::vector<glm::vec3> vertices_of(const std::vector<MeshPart>& parts) {
    std::vector<glm::vec3> vertices;
    for (const MeshPart& part : parts)
        vertices.insert(vertices.end(), part.mesh.vertices_m.begin(), part.mesh.vertices_m.end());
    return vertices;
}

/// That `moved` has each vertex of `plain` where the transform puts it, and the volume's sign.
void expect_moved(const std::vector<MeshPart>& plain, const std::vector<MeshPart>& moved,
                  const glm::dmat4& transform) {
    const auto found = vertices_of(moved);
    for (const glm::vec3& vertex : vertices_of(plain)) {
        const glm::vec3 wanted = transform * glm::dvec4{glm::dvec3{vertex}, 1.0};
        EXPECT_TRUE(std::ranges::any_of(
            found, [&](const glm::vec3& v) { return glm::distance(v, wanted) < 1e-5F; }));
    }
    const auto volume = [](const std::vector<MeshPart>& parts) {
        double sum = 0.0;
        for (const MeshPart& part : parts) {
            for (const glm::uvec3& t : part.mesh.triangles) {
                const auto& v = part.mesh.vertices_m;
                sum += glm::dot(glm::dvec3{v[t.x]},
                                glm::cross(glm::dvec3{v[t.y]}, glm::dvec3{v[t.z]}));
            }
        }
        return sum;
    };
    EXPECT_NEAR(volume(moved) / volume(plain), std::abs(glm::determinant(glm::dmat3{transform})),
                1e-4);
}

TEST(MeshFormat, noTransformOfANodeIsTooSmall) {
    const TempDir folder;
    const auto loaded = [](const std::filesystem::path& file) {
        return load_mesh_parts(file, glm::dvec3{1.0}, MeshAxes::z_up);
    };
    const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
        const auto at = text.find(what);
        EXPECT_NE(at, text.npos) << what;
        return text.replace(at, what.size(), by);
    };
    const std::string dae = dae_text(corners_of({}, as_it_is), "<up_axis>Z_UP</up_axis>");
    const std::string gltf = gltf_text(corners_of({}, y_up_from_z_up));
    const auto plain_dae = loaded(folder.write("a.dae", dae));
    const auto plain_gltf = loaded(folder.write("a.gltf", gltf));
    const glm::dmat4 y_up{glm::dmat3{y_up_from_z_up}};
    for (const glm::dmat4& transform : small_transforms()) {
        const std::string node = "<node><matrix>" + numbers_of(transform, true, ' ') + "</matrix>";
        // The outer node has another one, and both count.
        const std::string nested =
            replaced(replaced(dae, "<node>", node + node), "</node>", "</node></node>");
        SCOPED_TRACE(node);
        expect_moved(plain_dae, loaded(folder.write("b.dae", nested)), transform * transform);
        const std::string moved =
            replaced(gltf, "\"nodes\":[{\"mesh\":0}]",
                     "\"nodes\":[{\"mesh\":0,\"matrix\":[" +
                         numbers_of(y_up * transform * glm::inverse(y_up), false, ',') + "]}]");
        expect_moved(plain_gltf, loaded(folder.write("b.gltf", moved)), transform);
    }
}

/// The text with a comment in front of each `where`.
std::string commented(std::string text, const std::string& where) {
    const std::string comment = " <!-- 7 7 7 <p> -->";
    for (auto at = text.find(where); at != text.npos; at = text.find(where, at)) {
        text.insert(at, comment);
        at += comment.size() + where.size();
    }
    return text;
}

// Assimp refuses a comment in <vertices>, and reads the numbers up to a comment only.
TEST(MeshFormat, commentsMayStandAnywhereInCollada) {
    const TempDir folder;
    const std::string dae = dae_text(corners_of({}, as_it_is), "<up_axis>Z_UP</up_axis>");
    const auto plain = load_mesh_parts(folder.write("a.dae", dae));
    std::vector<std::string> texts{"<!-- made by hand -->\n" + dae,
                                   "\n<?note for a program?>" + dae};
    for (const char* where :
         {"<input", "<p>", "</p>", "<float_array", "1 -2 0.5", " 2 1", "<param", "<accessor",
          "<node>", "<instance_geometry", "<up_axis>", "</mesh>"}) {
        const std::string text = commented(dae, where);
        ASSERT_NE(text, dae) << where;
        texts.push_back(text);
    }
    for (const std::string& text : texts) {
        SCOPED_TRACE(text);
        const auto parts = load_mesh_parts(folder.write("b.dae", text));
        ASSERT_EQ(parts.size(), plain.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            EXPECT_EQ(parts[i].mesh.vertices_m, plain[i].mesh.vertices_m);
            EXPECT_EQ(parts[i].mesh.triangles, plain[i].mesh.triangles);
        }
    }
}

// Two nodes show one mesh, the second as in a mirror and a little turned: each by its name.
TEST(MeshFormat, aSubmeshHasTheTransformsOfItsNode) {
    const TempDir folder;
    const std::string dae = dae_text(corners_of({}, as_it_is), "<up_axis>Z_UP</up_axis>");
    const auto begin = dae.find("<node>");
    const auto end = dae.find("</node>");
    ASSERT_NE(begin, dae.npos);
    const std::string inside = dae.substr(begin + 6, end - begin - 6);
    const glm::dmat4 transform = small_transforms().back();
    const auto file = folder.write("a.dae", dae.substr(0, begin) + "<node name='left'>" + inside +
                                                "</node><node name='right'><matrix>" +
                                                numbers_of(transform, true, ' ') + "</matrix>" +
                                                inside + dae.substr(end));
    const auto left = load_submesh(file, "left");
    expect_moved(left, load_submesh(file, "right"), transform);
    const auto both = load_mesh_parts(file);
    expect_moved(left, left, glm::dmat4{1.0});
    EXPECT_EQ(vertices_of(both).size(), 2 * vertices_of(left).size());
    EXPECT_EQ(both.size(), left.size());
}

TEST(MeshFormat, aFileThatNamesNoMaterialHasNone) {
    const TempDir folder;
    const auto material = [&](const char* name, const std::string& text) {
        const auto parts = load_mesh_parts(folder.write(name, text));
        return parts.size() == 1 ? parts[0].material : "several";
    };
    const auto corners = corners_of({}, as_it_is);
    EXPECT_EQ(material("a.gltf", plain_gltf_text(corners)), "");
    EXPECT_EQ(material("a.dae", plain_dae_text(corners)), "");
    EXPECT_EQ(material("a.stl", stl_text(corners)), "");
    EXPECT_EQ(material("a.ply", ply_text(corners)), "");
}

// Assimp calls a camera as its node, and wants each name once.
TEST(MeshFormat, camerasOfOneNameAreInNobodysWay) {
    const TempDir folder;
    std::string text = dae_text(corners_of({}, as_it_is), "<up_axis>Z_UP</up_axis>");
    const auto insert = [&](const std::string& before, const std::string& what) {
        const auto at = text.find(before);
        ASSERT_NE(at, text.npos) << before;
        text.insert(at, what);
    };
    const std::string camera =
        "<camera id='c' name='Camera'><optics><technique_common><perspective><xfov>49</xfov>"
        "</perspective></technique_common></optics></camera>";
    insert("<library_geometries>", "<library_cameras>" + camera + "</library_cameras>");
    insert("</visual_scene>",
           "<node id='n' name='Camera'><instance_camera url='#c'/><instance_camera "
           "url='#c'/></node>");
    const auto parts = load_mesh_parts(folder.write("a.dae", text));
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].mesh.triangles.size() + parts[1].mesh.triangles.size(), 12U);
}

TEST(MeshFormat, aMeshInMillimetresIsWarnedOf) {
    const TempDir folder;
    const auto file =
        folder.write("a.stl", stl_bytes(corners_of({{0, 0, 0}, {12'000, 1, 1}}, as_it_is)));
    EXPECT_THAT(load_scene(file).warnings,
                Contains(HasSubstr("a.stl: reaches 12000 m from its origin")));
}

TEST(MeshFormat, worldsOfOtherKindsAreRefusedByName) {
    const TempDir folder;
    EXPECT_THAT(
        faults_of([&] { load_scene(folder.path() / "a.blend"); }, folder),
        ElementsAre("a.blend: is no kind of world that is known; name an SDF (.sdf, .world, "
                    ".model), a URDF (.urdf, .xacro), a world of Stage (.world) or MVSim (.xml), a "
                    "ROS map (.yaml, .yml) or a mesh (.obj, .stl, .ply, .dae, .gltf, "
                    ".glb), or the folder of a model"));
    EXPECT_THAT(faults_of([&] { load_scene(folder.path() / "a.stl"); }, folder),
                ElementsAre("a.stl: no such file; a mesh is wanted here"));
    EXPECT_THAT(faults_of([&] { load_scene(folder.path() / "a.YML"); }, folder),
                ElementsAre("a.YML: no such file; name the YAML of a ROS map"));
    EXPECT_THAT(faults_of([&] { load_scene(folder.path() / "a.World"); }, folder),
                ElementsAre("a.World: no such file; name an SDF world or model"));
}

}  // namespace
}  // namespace scipd::sim
