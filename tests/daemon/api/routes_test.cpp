// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The control API's documents, literally, against a daemon that is a few fields.
#include "daemon/api/routes.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/device/sensor_record.h"
#include "tests/support/empty_api.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class FakeApi : public tests::EmptyApi {
  public:
    [[nodiscard]] RigReport report() const override { return report_; }

    [[nodiscard]] std::optional<SensorLog> log(const std::string& sensor) const override {
        return sensor == "rescue/front" ? std::optional<SensorLog>(log_) : std::nullopt;
    }

    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(
        const std::string& robot) const override {
        if (robot != "rescue" && robot != "a robot/b") return {};
        return now_;
    }

    sim::Expected<> set_robot_pose(const std::string& robot, const sim::PoseLine& said) override {
        if (refusal_) return sim::refuse(*refusal_);
        robot_ = robot;
        time_ = said.time;
        now_.pose = said.pose;
        velocity_ = said.velocity;
        return {};
    }

    [[nodiscard]] SceneView scene() const override { return {"/scenes/room.sdf", scene_}; }

    void edit_scene(SceneEdit edit, EditDone done, std::stop_token) override {
        edits_.push_back(std::move(edit));
        done(outcome_);
    }

    [[nodiscard]] std::optional<sim::TimedPose> model_pose(
        const std::string& model) const override {
        if (model != "model 1") return {};
        return door_;
    }

    sim::Expected<> set_model_pose(const std::string&, const sim::PoseLine& said) override {
        if (refusal_) return sim::refuse(*refusal_);
        door_ = {said.time.value_or(0ns), said.pose};
        velocity_ = said.velocity;
        return {};
    }

    RigReport report_;
    ScanLog log_;
    sim::SharedScene scene_ = sim::SceneBuilder()
                                  .add(sim::Box{{1, 1, 1}}, {}, 1)
                                  .with(sim::Sphere{1.0}, {}, 0)
                                  .movable({})
                                  .with(sim::Box{{1, 1, 1}}, {}, 2)
                                  .build();
    sim::TimedPose door_{2s, {{1, 2, 3}, {1, 0, 0, 0}}};
    std::vector<SceneEdit> edits_;
    EditOutcome outcome_;
    sim::TimedPose now_;
    std::optional<std::string> refusal_;
    std::string robot_;
    std::optional<sim::Time> time_;
    std::optional<sim::Velocity> velocity_;
};

class RoutesTest : public testing::Test {
  protected:
    HttpResponse ask(const HttpRequest& request) {
        std::optional<HttpResponse> answer;
        route(api_, request, [&](const HttpResponse& response) { answer = response; });
        return answer.value();
    }
    HttpResponse get(const std::string& path) { return ask({"GET", path, "", ""}); }
    HttpResponse put(const std::string& path, const std::string& body) {
        return ask({"PUT", path, "", body});
    }

    FakeApi api_;
};

json document(const HttpResponse& response) {
    return json::parse(response.body);
}

/// The status, and that it is a problem document of that status.
int problem_status(const HttpResponse& response) {
    EXPECT_EQ(response.content_type, "application/problem+json");
    const json said = document(response);
    EXPECT_EQ(said["type"], "about:blank");
    EXPECT_EQ(said["status"], response.status);
    EXPECT_FALSE(said["title"].get<std::string>().empty());
    EXPECT_FALSE(said["detail"].get<std::string>().empty());
    return response.status;
}

RigReport busy_report() {
    SensorReport front;
    front.name = "rescue/front";
    front.model = "UST-10LX";
    front.backend = "embree";
    front.backend_reason = "0.030 ms per scan; depth: 0.600 ms";
    front.errors = ReadingErrors{.noise = 2.0, .own_bias = true, .bias = {{1.0, 0.01}}};
    front.seed = 18446744073709551615U;
    front.state = "measuring";
    front.tcp = "127.0.0.1:10940";
    front.clients = 1;
    front.connected = {"127.0.0.1:49152"};
    front.waiting = {"127.0.0.1:49160"};
    front.faults = {"cut", "sums"};
    front.counts.scans = 4000;
    front.counts.casts = {{"embree", {4001, {}}}, {"depth", {2, {}}}};
    front.counts.lost = 2;
    front.stream_lost = 3;
    for (int i = 0; i < 7; ++i)
        front.counts.lateness.add(20us);
    for (int i = 0; i < 3; ++i)
        front.counts.lateness.add(100us);
    front.counts.lateness.add(140ms);
    front.counts_before.scans = 5;
    SensorReport rear;
    rear.name = "rescue/rear";
    rear.model = "URG-04LX";
    rear.backend = "reference";
    rear.state = "idle";
    rear.warning = "is inside model hull";
    rear.pty = "/run/scipd/rear";

    RigReport report;
    report.uptime = 100.5s;
    report.clock = "wall";
    report.time = 100250ms;
    report.scene = "/scenes/room.sdf";
    report.warnings = {"room.sdf: a wall is missing"};
    report.poses = {7, 1, "q must be a quaternion"};
    report.sensors = {front, rear};
    return report;
}

constexpr const char* front_text =
    R"({"name":"rescue/front","model":"UST-10LX","backend":"embree",)"
    R"("backend_reason":"0.030 ms per scan; depth: 0.600 ms",)"
    R"("errors":{"accuracy":"sensor","noise":2.0,"bias":[{"range_m":1.0,"bias_m":0.01}],)"
    R"("interference":false},"seed":"18446744073709551615",)"
    R"("state":"measuring","warning":null,)"
    R"("tcp":"127.0.0.1:10940","pty":null,"clients":1,)"
    R"("connected":["127.0.0.1:49152"],"waiting":["127.0.0.1:49160"],)"
    R"("faults":["cut","sums"],"scans":4000,)"
    R"("casts":{"depth":2,"embree":4001},"lost":2,"stream_lost":3,)"
    R"("lateness_ms":{"p50":0.020749,"p99":140.0,"max":140.0},)"
    R"("lateness_histogram":{"le_ms":[0.016,0.032,0.064,0.128,0.256,0.512,1.024,2.048,4.096,)"
    R"(8.192,16.384,32.768,65.536,131.072],"counts":[0,7,0,3,0,0,0,0,0,0,0,0,0,0,1]}})";
constexpr const char* rear_text =
    R"({"name":"rescue/rear","model":"URG-04LX","backend":"reference","backend_reason":null,)"
    R"("errors":null,"seed":"0",)"
    R"("state":"idle","warning":"is inside model hull",)"
    R"("tcp":null,"pty":"/run/scipd/rear","clients":0,"connected":[],"waiting":[],)"
    R"("faults":[],"scans":0,)"
    R"("casts":{},"lost":0,"stream_lost":0,)"
    R"("lateness_ms":{"p50":null,"p99":null,"max":null},"lateness_histogram":null})";

TEST_F(RoutesTest, StatusIsTheWholeDocument) {
    api_.report_ = busy_report();
    const auto response = get("/status");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(response.content_type, "application/json");
    EXPECT_EQ(
        response.body,
        std::string{R"({"uptime_s":100.5,"clock":"wall","time_s":100.25,)"
                    R"("scene":"/scenes/room.sdf","warnings":["room.sdf: a wall is missing"],)"
                    R"("poses":{"accepted":7,"refused":1,)"
                    R"("last_refusal":"q must be a quaternion","sources":[]},)"
                    R"("fleet":null,"sensors":[)"} +
            front_text + "," + rear_text + "]}\n");
}

TEST_F(RoutesTest, WhatIsUnknownIsNull) {
    const json said = document(get("/status"));
    EXPECT_EQ(said["poses"]["last_refusal"], nullptr);
    EXPECT_EQ(said["sensors"], json::array());
}

TEST_F(RoutesTest, SensorsAreListedAndFoundByName) {
    api_.report_ = busy_report();
    EXPECT_EQ(get("/sensors").body, std::string{"["} + front_text + "," + rear_text + "]\n");
    EXPECT_EQ(get("/sensors/rescue/front").body, std::string{front_text} + "\n");
    EXPECT_EQ(get("/sensors/rescue/rear").body, std::string{rear_text} + "\n");
    EXPECT_EQ(problem_status(get("/sensors/rescue/top")), 404);
    EXPECT_EQ(document(get("/sensors/rescue/top"))["detail"], "there is no sensor \"rescue/top\"");
}

TEST_F(RoutesTest, APoseIsToldInTheWordsOfAPoseLine) {
    api_.now_ = {1500ms, {{1.0, -2.0, 0.25}, {0.0, 0.0, 0.0, 1.0}}};
    const auto response = get("/robots/rescue/pose");
    EXPECT_EQ(response.body, R"({"robot":"rescue","t":1.5,"xyz":[1.0,-2.0,0.25],)"
                             R"("q":[0.0,0.0,1.0,0.0]})"
                             "\n");
    EXPECT_EQ(put("/robots/rescue/pose", response.body).status, 204);
    EXPECT_EQ(api_.time_, 1500ms);
}

TEST_F(RoutesTest, APoseIsSetFromQuaternionOrAngles) {
    const auto response =
        put("/robots/rescue/pose", R"( {"xyz":[1,2,3],"q":[0,0,2,0],"t":0.000000001})");
    EXPECT_EQ(response.status, 204);
    EXPECT_EQ(response.body, "");
    EXPECT_EQ(api_.robot_, "rescue");
    EXPECT_EQ(api_.time_, 1ns);
    EXPECT_EQ(api_.now_.pose.translation_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(api_.now_.pose.rotation, glm::dquat(0, 0, 0, 1));

    EXPECT_EQ(put("/robots/rescue/pose", R"({"xyz":[0,0,0],"rpy":[0,0,1.5]})").status, 204);
    EXPECT_EQ(api_.time_, std::nullopt);
    EXPECT_EQ(api_.now_.pose, sim::pose_from_rpy({0, 0, 0}, {0, 0, 1.5}));
}

TEST_F(RoutesTest, APoseMayHaveItsVelocity) {
    const sim::Velocity velocity{{1, 0, 0}, {0, 0, 0.5}};
    const char* const body = R"({"xyz":[1,2,3],"v":[1,0,0],"w":[0,0,0.5]})";
    EXPECT_EQ(put("/robots/rescue/pose", body).status, 204);
    EXPECT_EQ(std::exchange(api_.velocity_, {}), velocity);
    EXPECT_EQ(put("/scene/models/model%201/pose", body).status, 204);
    EXPECT_EQ(api_.velocity_, velocity);
}

TEST_F(RoutesTest, AWrongPoseNamesItsField) {
    const std::pair<const char*, const char*> table[] = {
        {R"({"xyz":[1,2]})", "xyz"},
        {R"({"xyz":"here"})", "xyz"},
        {R"({})", "xyz"},
        {R"({"xyz":[1,2,3],"q":[0,0,0,0]})", "q"},
        {R"({"xyz":[1,2,3],"q":[0,0,0,1],"rpy":[0,0,0]})", "q"},
        {R"({"xyz":[1,2,3],"rpy":[0,0]})", "rpy"},
        {R"({"xyz":[1,2,3],"t":"now"})", "t"},
        {R"({"xyz":[1,2,3],"yaw":1})", "yaw"},
        {R"({"xyz":[1,2,3],"it's":1})", "it's"},
        {R"({"xyz":[1,2,3],"robot":"other"})", "robot"},
        {R"({"xyz":[1,2,3],"model":"door"})", "model"},
        {R"({"xyz":[1,2,3],"v":[1,0]})", "v"},
        {R"({"xyz":[1,2,3],"w":[1,0]})", "w"},
    };
    for (const auto& [body, field] : table) {
        const auto response = put("/robots/rescue/pose", body);
        EXPECT_EQ(problem_status(response), 400) << body;
        EXPECT_EQ(document(response)["field"], field) << body;
    }
    for (const char* body : {"", "  ", "1 1 2 3 0 0 0 1", "[1]", "{\"xyz\":[1,2,3]", "{\xff}"}) {
        const auto response = put("/robots/rescue/pose", body);
        EXPECT_EQ(problem_status(response), 400) << body;
        EXPECT_FALSE(document(response).contains("field")) << body;
    }
    EXPECT_EQ(api_.robot_, "");
}

TEST_F(RoutesTest, APoseThatDoesNotFitNowIsAConflict) {
    api_.refusal_ = "t lies before the last pose";
    const auto response = put("/robots/rescue/pose", R"({"xyz":[1,2,3],"t":1})");
    EXPECT_EQ(problem_status(response), 409);
    EXPECT_EQ(document(response)["detail"], "t lies before the last pose");
}

TEST_F(RoutesTest, NoSuchRobotIsNotFoundForAllMethods) {
    EXPECT_EQ(problem_status(get("/robots/nobody/pose")), 404);
    EXPECT_EQ(problem_status(put("/robots/nobody/pose", R"({"xyz":[1,2,3]})")), 404);
    EXPECT_EQ(api_.robot_, "");
}

TEST_F(RoutesTest, AWrongMethodIsToldTheRightOnes) {
    api_.report_ = busy_report();
    const std::pair<const char*, const char*> table[] = {
        {"/status", "GET"},
        {"/sensors", "GET, POST"},
        {"/sensors/rescue/front/replay", "GET, PATCH"},
        {"/robots/rescue/pose", "GET, PUT"},
        {"/scene", "GET, PUT"},
        {"/scene/models", "POST"},
        {"/scene/models/door/pose", "GET, PUT"},
        {"/poses", "GET"},
        {"/stream", "GET"},
        {"/view", "GET"},
        {"/wire", "GET"},
    };
    for (const auto& [path, allow] : table) {
        const auto response = ask({"DELETE", path, "", ""});
        EXPECT_EQ(problem_status(response), 405) << path;
        EXPECT_EQ(response.allow, allow) << path;
    }
}

TEST_F(RoutesTest, UnknownPathsAreNotFound) {
    for (const char* path : {"", "//", "status", "/status/", "/Status", "/sensors/rescue",
                             "/robots", "/robots/rescue", "/robots/rescue/pose/x", "*"}) {
        EXPECT_EQ(problem_status(get(path)), 404) << path;
    }
}

TEST_F(RoutesTest, UnknownPathsAreToldTheKnownOnes) {
    const std::string said = document(get("/dance"))["detail"];
    for (const Route& entry : routes())
        EXPECT_THAT(said, testing::HasSubstr(entry.path));
}

TEST_F(RoutesTest, NamesCanHoldWhatPathsCannot) {
    const auto response = get("/robots/a%20robot%2Fb/pose");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(document(response)["robot"], "a robot/b");
    for (const char* path : {"/robots/%/pose", "/robots/%2/pose", "/robots/%2x/pose",
                             "/robots/%-1/pose", "/robots/rescue%/pose"}) {
        EXPECT_EQ(problem_status(get(path)), 400) << path;
    }
}

TEST_F(RoutesTest, TheSceneIsListed) {
    EXPECT_EQ(get("/scene").body,
              R"({"file":"/scenes/room.sdf","name":"","models":[)"
              R"({"name":"model 0","movable":false,"pose":{"xyz":[0.0,0.0,0.0],)"
              R"("q":[0.0,0.0,0.0,1.0]},"objects":2,"materials":["default","material 1"]},)"
              R"({"name":"model 1","movable":true,"pose":{"xyz":[1.0,2.0,3.0],)"
              R"("q":[0.0,0.0,0.0,1.0]},"objects":1,"materials":["material 2"]}],)"
              R"("materials":["default","material 1","material 2"],"sensors":[]})"
              "\n");
}

TEST_F(RoutesTest, AnotherWorldIsAskedFor) {
    api_.outcome_.messages = {"light: nothing to a scanner"};
    const auto response = put("/scene", R"({"file":"other.sdf"})");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(response.body, R"({"warnings":["light: nothing to a scanner"]})"
                             "\n");
    ASSERT_EQ(api_.edits_.size(), 1U);
    EXPECT_EQ(std::get<LoadWorld>(api_.edits_[0]).file, "other.sdf");
}

TEST_F(RoutesTest, AModelIsAskedFor) {
    EXPECT_EQ(ask({"POST", "/scene/models", "",
                   R"({"name":"a","sdf":"<model/>","pose":{"xyz":[1,2,3],"rpy":[0,0,1.5]}})"})
                  .status,
              201);
    EXPECT_EQ(ask({"POST", "/scene/models", "",
                   R"({"name":"b","mesh":"b.stl","scale":0.001,"material":"wood","replace":true})"})
                  .status,
              201);
    EXPECT_EQ(ask({"DELETE", "/scene/models/a%3A%3Ab", "", ""}).status, 204);
    EXPECT_EQ(
        ask({"POST", "/scene/models", "", R"({"name":"c","file":"shelf","static":true})"}).status,
        201);
    EXPECT_EQ(ask({"POST", "/scene/models", "",
                   R"({"name":"a","sdf":"<model/>","pose":{"xyz":[1,2,3],"rpy":[0,0,90]}})"})
                  .status,
              201);
    ASSERT_EQ(api_.edits_.size(), 5U);
    const auto& turned = std::get<AddModel>(api_.edits_[4]);
    EXPECT_EQ(turned.placement.world_from_model, sim::pose_from_rpy({1, 2, 3}, {0, 0, 90}));
    EXPECT_THAT(
        turned.warnings,
        ElementsAre("pose.rpy: 0, 0, 90 looks like degrees, but angles are radians; did you "
                    "mean 0, 0, 1.5708?"));
    const auto& text = std::get<AddModel>(api_.edits_[0]);
    EXPECT_TRUE(text.warnings.empty());
    EXPECT_EQ(text.placement.name, "a");
    EXPECT_EQ(text.placement.world_from_model, sim::pose_from_rpy({1, 2, 3}, {0, 0, 1.5}));
    EXPECT_EQ(text.sdf, "<model/>");
    EXPECT_EQ(text.placement.movable, std::nullopt);
    EXPECT_FALSE(text.replace);
    const auto& mesh = std::get<AddModel>(api_.edits_[1]);
    EXPECT_EQ(mesh.placement.world_from_model, std::nullopt);
    EXPECT_EQ(mesh.mesh, "b.stl");
    EXPECT_EQ(mesh.scale, 0.001);
    EXPECT_EQ(mesh.material, "wood");
    EXPECT_TRUE(mesh.replace);
    EXPECT_EQ(std::get<RemoveModel>(api_.edits_[2]).name, "a::b");
    const auto& folder = std::get<AddModel>(api_.edits_[3]);
    EXPECT_EQ(folder.file, "shelf");
    EXPECT_EQ(folder.placement.movable, false);
}

TEST_F(RoutesTest, AModelGetsAnotherMaterial) {
    EXPECT_EQ(put("/scene/models/a%3A%3Ab/material", R"({"material":"wood"})").status, 200);
    ASSERT_EQ(api_.edits_.size(), 1U);
    const auto& edit = std::get<SetMaterial>(api_.edits_[0]);
    EXPECT_EQ(edit.model, "a::b");
    EXPECT_THAT(edit.materials, ElementsAre("wood"));
    EXPECT_EQ(put("/scene/models/a/material", R"({"materials":["wood","gold"]})").status, 200);
    EXPECT_THAT(std::get<SetMaterial>(api_.edits_[1]).materials, ElementsAre("wood", "gold"));
    for (const char* body :
         {"{}", R"({"material":""})", R"({"materials":[]})", R"({"materials":"wood"})",
          R"({"materials":["wood",1]})", R"({"material":"wood","materials":["wood"]})",
          R"({"material":1})", R"({"colour":"x"})", R"({"material":"a\u0000b"})",
          R"({"material":"a\nb"})"})
        EXPECT_EQ(problem_status(put("/scene/models/a/material", body)), 400) << body;
}

TEST_F(RoutesTest, AWrongModelNamesItsField) {
    const std::pair<std::string, const char*> table[] = {
        {R"({})", "name"},
        {R"({"name":""})", "name"},
        {R"({"name":1,"sdf":"x"})", "name"},
        {R"({"name":"a"})", "sdf"},
        {R"({"name":"a","sdf":"x","mesh":"y"})", "sdf"},
        {R"({"name":"a","file":"x","mesh":"y"})", "sdf"},
        {R"({"name":"a","mesh":"a.stl\u0000.txt"})", "mesh"},
        {R"({"name":"a","file":"a\n.sdf"})", "file"},
        {R"({"name":"a","file":""})", "file"},
        {R"({"name":"a","file":"x","static":"no"})", "static"},
        {R"({"name":"a","sdf":1})", "sdf"},
        {R"({"name":"a","mesh":"y","scale":"big"})", "scale"},
        {R"({"name":"a","sdf":"x","scale":2})", "scale"},
        {R"({"name":"a","sdf":"x","material":"wood"})", "material"},
        {R"({"name":"a","sdf":"x","replace":1})", "replace"},
        {R"({"name":"a","sdf":"x","pose":[1]})", "pose"},
        {R"({"name":"a","sdf":"x","pose":{"xyz":[1]}})", "pose"},
        {R"({"name":"a","sdf":"x","pose":{"xyz":[1,2,3],"t":1}})", "pose"},
        {R"({"name":"a","sdf":"x","pose":{"xyz":[1,2,3],"v":[1,0,0]}})", "pose"},
        {R"({"name":"a","sdf":"x","pose":{"xyz":[[1],2,3]}})", "pose"},
        {R"({"name":"a","sdf":"x","colour":"red"})", "colour"},
        {R"({"name":"a","mesh":"x","mesh_data":"AAAA","mesh_format":"stl"})", "sdf"},
        {R"({"name":"a","mesh_data":"AAAA"})", "mesh_format"},
        {R"({"name":"a","mesh":"x","mesh_format":"stl"})", "mesh_format"},
        {R"({"name":"a","mesh_data":"AAA","mesh_format":"stl"})", "mesh_data"},
        {R"({"name":"a","mesh_data":"A=AA","mesh_format":"stl"})", "mesh_data"},
        {R"({"name":"a","mesh_data":"AA\nA","mesh_format":"stl"})", "mesh_data"},
        {R"({"name":"a","mesh_data":"AAAA","mesh_format":"../stl"})", "mesh_format"},
        {R"({"name":"a","mesh_data":"AAAA","mesh_format":"sdf"})", "mesh_format"},
    };
    for (const auto& [body, field] : table) {
        const auto response = ask({"POST", "/scene/models", "", body});
        EXPECT_EQ(problem_status(response), 400) << body;
        EXPECT_EQ(document(response)["field"], field) << body;
    }
    for (const std::string& name : {std::string(65, 'n'), std::string(R"(a\u001b[2J)")}) {
        const auto response =
            ask({"POST", "/scene/models", "", R"({"sdf":"x","name":")" + name + "\"}"});
        EXPECT_EQ(problem_status(response), 400) << name;
        EXPECT_EQ(document(response)["field"], "name") << name;
    }
    for (const char* body : {"", "[]", "{", "\xff"}) {
        EXPECT_EQ(problem_status(ask({"POST", "/scene/models", "", body})), 400);
        EXPECT_EQ(problem_status(put("/scene", body)), 400);
    }
    EXPECT_EQ(document(put("/scene", R"({"file":3})"))["field"], "file");
    // A pose is read as the JSON that it is: a line would be too long for this key.
    const auto response = ask(
        {"POST", "/scene/models", "",
         R"({"name":"a","sdf":"x","pose":{"xyz":[1,2,3],")" + std::string(5000, 'k') + R"(":0}})"});
    EXPECT_THAT(document(response)["detail"].get<std::string>(),
                testing::StartsWith("pose: the key 'kkkk"));
    EXPECT_TRUE(api_.edits_.empty());
}

// Read to their ends, these would hold every scanner up.
TEST_F(RoutesTest, ABodyThatIsDeepOrWideIsRefusedBeforeItsEnd) {
    std::string wide = "{";
    for (int i = 0; i < 100'000; ++i)
        wide += "\"k" + std::to_string(i) + "\":1,";
    std::string list = R"({"name":[)";
    for (int i = 0; i < 400'000; ++i)
        list += "1,";
    for (const std::string& body :
         {std::string(1'000'000, '['), "{\"name\":" + std::string(1'000'000, '['), wide, list,
          std::string(1'000'000, '{')}) {
        for (const char* path : {"/scene", "/scene/models", "/robots/rescue/pose"}) {
            const bool is_model = std::string_view(path) == "/scene/models";
            const auto response = ask({is_model ? "POST" : "PUT", path, "", body});
            EXPECT_EQ(problem_status(response), 400) << path << ' ' << body.substr(0, 20);
            const std::string why = document(response)["detail"];
            // What is refused at the end of all that lacks its closing bracket was read to there.
            EXPECT_THAT(why, testing::Not(testing::HasSubstr("end of input"))) << path;
            EXPECT_LT(response.body.size(), 1000U);
        }
    }
}

TEST_F(RoutesTest, AnEditThatFailsSaysWhy) {
    using Result = EditOutcome::Result;
    const std::pair<Result, int> table[] = {
        {Result::faulty, 400}, {Result::unknown, 404}, {Result::taken, 409}};
    for (const auto& [result, status] : table) {
        api_.outcome_ = {result, {"first", "second"}};
        const auto response = ask({"POST", "/scene/models", "", R"({"name":"a","sdf":"x"})"});
        EXPECT_EQ(problem_status(response), status);
        EXPECT_EQ(document(response)["detail"], "first\nsecond");
        EXPECT_EQ(document(response).contains("field"), result == Result::faulty);
    }
}

TEST_F(RoutesTest, AModelIsMovedInTheWordsOfAPoseLine) {
    const auto response = get("/scene/models/model%201/pose");
    EXPECT_EQ(response.body,
              R"({"model":"model 1","t":2.0,"xyz":[1.0,2.0,3.0],"q":[0.0,0.0,0.0,1.0]})"
              "\n");
    EXPECT_EQ(put("/scene/models/model%201/pose", response.body).status, 204);
    EXPECT_EQ(put("/scene/models/model%201/pose", R"({"xyz":[4,5,6]})").status, 204);
    EXPECT_EQ(api_.door_.pose.translation_m, glm::dvec3(4, 5, 6));
    EXPECT_EQ(problem_status(put("/scene/models/model%200/pose", R"({"xyz":[4,5,6]})")), 404);
    for (const char* body : {R"({"xyz":[1,2,3],"model":"other"})", R"({"xyz":[1,2,3],"robot":"r"})",
                             R"({"xyz":[1,2]})"}) {
        EXPECT_EQ(problem_status(put("/scene/models/model%201/pose", body)), 400) << body;
    }
    api_.refusal_ = "model: \"model 1\" is the body of a robot; move the robot";
    EXPECT_EQ(problem_status(put("/scene/models/model%201/pose", R"({"xyz":[4,5,6]})")), 409);
}

TEST_F(RoutesTest, AWebSocketIsNoDocument) {
    EXPECT_EQ(problem_status(get("/poses")), 426);
    EXPECT_EQ(problem_status(get("/stream")), 426);
}

TEST_F(RoutesTest, BytesThatAreNoTextStillGiveJson) {
    EXPECT_EQ(problem_status(get("/robots/\xff\xfe/pose")), 404);
    EXPECT_EQ(problem_status(get("/\x80")), 404);
}

}  // namespace
}  // namespace scipd::daemon
