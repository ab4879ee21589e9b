// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/scene_request.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {
namespace {

SceneRequest through_a_file(const SceneRequest& request) {
    const File file = memory_file();
    put_request(request, file.get());
    std::rewind(file.get());
    return take_request(file.get());
}

SceneRequest full_request() {
    SceneRequest request{};
    request.sdf = {.geometry = SdfGeometry::collision,
                   .xacro = {{"angle", "40"}, {"name", "a b"}},
                   .model_folders = {"/a", "/b c"},
                   .most_memory_bytes = 11,
                   .most_triangles = 12,
                   .mesh = {.memory_bytes = 13, .triangles = 14},
                   .strict = true};
    request.map = {.bottom_m = 0.5, .top_m = 3.0, .material = "oak", .unknown = UnknownCells::wall};
    request.most_overlap = 15;
    request.folders = Folders{"/allowed"};
    request.memory_bytes = 16;
    request.processor_time = std::chrono::seconds{17};
    request.asked_by = 18;
    return request;
}

void expect_same_options(const SceneRequest& is, const SceneRequest& was) {
    EXPECT_EQ(is.sdf.geometry, was.sdf.geometry);
    EXPECT_EQ(is.sdf.xacro, was.sdf.xacro);
    EXPECT_EQ(is.sdf.model_folders, was.sdf.model_folders);
    EXPECT_EQ(is.sdf.most_memory_bytes, was.sdf.most_memory_bytes);
    EXPECT_EQ(is.sdf.most_triangles, was.sdf.most_triangles);
    EXPECT_EQ(is.sdf.mesh.memory_bytes, was.sdf.mesh.memory_bytes);
    EXPECT_EQ(is.sdf.mesh.triangles, was.sdf.mesh.triangles);
    EXPECT_EQ(is.sdf.strict, was.sdf.strict);
    EXPECT_EQ(is.map, was.map);
    EXPECT_EQ(is.most_overlap, was.most_overlap);
    EXPECT_EQ(is.folders, was.folders);
    EXPECT_EQ(is.memory_bytes, was.memory_bytes);
    EXPECT_EQ(is.processor_time, was.processor_time);
    EXPECT_EQ(is.asked_by, was.asked_by);
}

TEST(SceneRequest, OfAWorldArrivesWhole) {
    SceneRequest sent = full_request();
    sent.wanted = SceneRequest::World{"/w/a b.sdf"};
    const SceneRequest arrived = through_a_file(sent);
    expect_same_options(arrived, sent);
    EXPECT_EQ(std::get<SceneRequest::World>(arrived.wanted), "/w/a b.sdf");
    EXPECT_EQ(arrived.name(), "/w/a b.sdf");
    EXPECT_EQ(arrived.file(), "/w/a b.sdf");
}

TEST(SceneRequest, OfAModelArrivesWhole) {
    SceneRequest sent = full_request();
    sent.folders.reset();
    const Pose pose = pose_from_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
    NewModel chair;
    chair.placement = {"chair", pose, false};
    chair.text = "<model/>";
    chair.folder = "/f";
    chair.file = "/a.sdf";
    chair.mesh = "/b.stl";
    chair.scale = 0.5;
    chair.material = "oak";
    sent.wanted = chair;
    const SceneRequest arrived = through_a_file(sent);
    expect_same_options(arrived, sent);
    const auto& model = std::get<NewModel>(arrived.wanted);
    EXPECT_EQ(model.placement.name, "chair");
    EXPECT_EQ(model.placement.world_from_model, pose);
    EXPECT_EQ(model.placement.movable, false);
    EXPECT_EQ(model.text, "<model/>");
    EXPECT_EQ(model.folder, "/f");
    EXPECT_EQ(model.file, "/a.sdf");
    EXPECT_EQ(model.mesh, "/b.stl");
    EXPECT_EQ(model.scale, 0.5);
    EXPECT_EQ(model.material, "oak");
    EXPECT_EQ(arrived.name(), "chair");
}

TEST(SceneRequest, OfAnotherVersionIsRefused) {
    const File file = memory_file();
    put_request(full_request(), file.get());
    std::fseek(file.get(), sizeof(std::uint64_t), SEEK_SET);
    std::fputc('S', file.get());
    std::rewind(file.get());
    EXPECT_THROW(take_request(file.get()), std::runtime_error);
}

}  // namespace
}  // namespace scipd::sim
