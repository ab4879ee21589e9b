// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Models are added, moved and removed, and worlds change, while scanners run.
#include <algorithm>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"
#include "tests/support/sanitized.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using Ranges = std::vector<std::uint32_t>;

constexpr std::size_t front = 540;

/// A model that is a cube of half a metre.
std::string cube() {
    return R"(<model name='any'><link name='l'><visual name='v'><geometry><box><size>0.5 0.5 0.5)"
           R"(</size></box></geometry></visual></link></model>)";
}

/// Its face is 0.25 m nearer than `x_m`.
nlohmann::json cube_at(double x_m) {
    return {{"name", "cube"}, {"sdf", cube()}, {"pose", {{"xyz", {x_m, 0.0, 0.3}}}}};
}

/// An STL of two triangles: a sheet of 1 m by 1 m in the plane x = 0, in millimetres.
constexpr const char* sheet_stl =
    "solid sheet\n"
    "facet normal 1 0 0\nouter loop\nvertex 0 -500 -500\nvertex 0 500 -500\nvertex 0 500 500\n"
    "endloop\nendfacet\n"
    "facet normal 1 0 0\nouter loop\nvertex 0 -500 -500\nvertex 0 500 500\nvertex 0 -500 500\n"
    "endloop\nendfacet\nendsolid sheet\n";

constexpr int most_on_their_way = 400;  ///< ten seconds

class SceneEdit : public testing::Test {
  protected:
    SceneEdit() { EXPECT_NE(daemon_.ready_line(), "") << daemon_.standard_error(); }

    ControlAnswer ask(const std::string& method, const std::string& path,
                      const nlohmann::json& body = nullptr) const {
        return control_request(daemon_.control(), method, path,
                               body.is_null() ? std::string() : body.dump());
    }

    std::string room_of(double half_m) {
        const std::string place = std::to_string(half_m + 0.5);
        return directory_.write("room.sdf", R"(<sdf version="1.9"><world name="room">
            <model name="wall"><static>true</static><link name="l"><visual name="v"><pose>)" +
                                                place + R"( 0 0 0 0 0</pose><geometry><box>
            <size>1 20 20</size></box></geometry></visual></link></model></world></sdf>)");
    }

    static std::string config(const TempDir& directory) {
        const std::string sensor =
            "{model: UST-10LX, mount: {xyz: [0, 0, 0.3]}, accuracy: ideal, tcp: \"127.0.0.1:0\"}\n";
        return directory.write("two.yaml", "scene: " + scene("square_room.sdf").string() +
                                               "\nrobots:\n  rescue:\n    sensors:\n      one: " +
                                               sensor + "      two: " + sensor);
    }

    TempDir directory_;
    DaemonProcess daemon_{directory_, {"--config", config(directory_)}};
};

/// Reads all scans of one scanner while the test does something else, and loses none.
class Watcher {
  public:
    explicit Watcher(std::uint16_t port) : wire_(ScannerWire::tcp(port)) {
        EXPECT_EQ(wire_.ask(stream_of_all_beams), "00");
        read();
    }

    void read() {
        const auto scan = wire_.next_scan();
        if (!seen_.empty()) {
            EXPECT_EQ(turns_between(stamp_ms_, scan.stamp_ms), 1);
        }
        stamp_ms_ = scan.stamp_ms;
        seen_.push_back(scan.distances_mm);
    }

    /// All scans since the last call.
    std::vector<Ranges> take() { return std::exchange(seen_, {}); }
    [[nodiscard]] const Ranges& latest() const { return seen_.back(); }

  private:
    ScannerWire wire_;
    std::uint32_t stamp_ms_ = 0;
    std::vector<Ranges> seen_;
};

/// A scan during which something moves may have beams of both.
void expect_one_of(const Ranges& scan, const Ranges& before, const Ranges& after, bool moves) {
    if (!moves) {
        EXPECT_TRUE(scan == before || scan == after);
        return;
    }
    for (std::size_t i = 0; i < scan.size(); ++i)
        EXPECT_TRUE(scan[i] == before[i] || scan[i] == after[i]);
}

TEST_F(SceneEdit, CostsNoScanAndIsSeenWholeOrNotAtAll) {
    Watcher one(daemon_.port(0));
    Watcher two(daemon_.port(1));
    const std::string other = room_of(2.0);
    const auto at = [](double x_m) { return nlohmann::json{{"xyz", {x_m, 0.0, 0.3}}}; };
    auto replacing = cube_at(2.0);
    replacing["replace"] = true;
    const std::string home = scene("square_room.sdf");
    struct Step {
        std::string method, path;
        nlohmann::json body;
        std::uint32_t front_mm;
        bool moves = false;
    };
    const std::vector<Step> steps{
        {"POST", "/scene/models", cube_at(1.5), 1250},
        {"PUT", "/scene/models/cube/pose", at(1.0), 750, true},
        {"POST", "/scene/models", replacing, 1750},
        {"PUT", "/scene", {{"file", other}}, 2000},
        {"POST", "/scene/models", cube_at(1.0), 750},
        {"DELETE", "/scene/models/cube", nullptr, 2000},
        {"PUT", "/scene", {{"file", home}}, 3000},
    };
    for (int round = 0; round < 3; ++round) {
        for (const Step& step : steps) {
            const Ranges before = one.latest();
            (void)one.take();
            (void)two.take();
            auto answer = std::async(std::launch::async,
                                     [&] { return ask(step.method, step.path, step.body); });
            const auto read_both = [&] { one.read(), two.read(); };
            while (answer.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
                read_both();
            const ControlAnswer said = answer.get();
            ASSERT_LT(said.status, 300) << step.method << " " << step.path << ": " << said.body;
            // Skips scans that were on their way, which are many on a busy machine, and those that
            // had begun.
            const auto is_seen = [&](const Watcher& by) {
                return by.latest()[front] == step.front_mm;
            };
            for (int i = 0; i < most_on_their_way && !(is_seen(one) && is_seen(two)); ++i)
                read_both();
            read_both();
            const Ranges after = one.latest();
            EXPECT_EQ(after[front], step.front_mm) << step.method << " " << step.path;
            for (Watcher* watcher : {&one, &two}) {
                EXPECT_EQ(watcher->latest(), after);
                for (const Ranges& scan : watcher->take())
                    expect_one_of(scan, before, after, step.moves);
            }
            one.read();
            two.read();
        }
    }
    for (const auto& sensor : daemon_.get("/sensors"))
        EXPECT_EQ(sensor.at("lost"), 0);
}

TEST_F(SceneEdit, TakesAMeshWithItsScaleAndMaterial) {
    const std::string file = directory_.write("sheet.stl", sheet_stl);
    const auto answer = ask("POST", "/scene/models",
                            {{"name", "a sheet"},
                             {"mesh", file},
                             {"scale", 0.001},
                             {"material", "glass"},
                             {"pose", {{"xyz", {1.5, 0, 0.3}}}}});
    EXPECT_EQ(answer.status, 201) << answer.body;
    Watcher watcher(daemon_.port());
    EXPECT_EQ(watcher.latest()[front], 1500U);
    const auto truth = daemon_.get("/sensors/rescue/one/truth");
    EXPECT_EQ(truth.at("material").at(front), "glass");
    EXPECT_EQ(truth.at("true_m").at(front), 1.5);
    const auto models = daemon_.get("/scene").at("models");
    EXPECT_EQ(models.back().at("name"), "a sheet");
    EXPECT_EQ(models.back().at("materials"), nlohmann::json({"glass"}));
    EXPECT_EQ(ask("DELETE", "/scene/models/a%20sheet").status, 204);
    EXPECT_EQ(daemon_.get("/scene").at("models").size(), models.size() - 1);
}

/// A sheet in the plane x = 0 that never moves, in a folder with Gazebo's layout. The URI of its
/// mesh is relative.
std::string write_sheet_folder(const TempDir& directory) {
    directory.write("models/sheet/model.config",
                    "<model><name>sheet</name><sdf version='1.6'>model.sdf</sdf></model>");
    directory.write("models/sheet/meshes/sheet.stl", sheet_stl);
    directory.write("models/sheet/model.sdf",
                    "<sdf version='1.6'><model name='sheet'><static>true</static><link name='l'>"
                    "<visual name='v'><geometry><mesh><uri>meshes/sheet.stl</uri><scale>0.001 "
                    "0.001 0.001</scale></mesh></geometry></visual></link></model></sdf>");
    return directory.path() / "models/sheet";
}

TEST_F(SceneEdit, TakesTheFolderOfAModelAsTheStartDoes) {
    const std::string folder = write_sheet_folder(directory_);
    const auto add = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {SCIPCTL, "--control", daemon_.control(), "scene", "add"});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    add({"fixed", folder, "--pose", "1.5,0,0"});
    add({"loose", folder, "--pose", "1,0,0", "--movable"});
    Watcher watcher(daemon_.port());
    EXPECT_EQ(watcher.latest()[front], 1000U);
    EXPECT_EQ(ask("PUT", "/scene/models/loose/pose", {{"xyz", {2.0, 0.0, 0.0}}}).status, 204);
    EXPECT_EQ(ask("PUT", "/scene/models/fixed/pose", {{"xyz", {9.0, 0.0, 0.0}}}).status, 404);
    for (int i = 0; i < 4; ++i)
        watcher.read();
    EXPECT_EQ(watcher.latest()[front], 1500U);

    const TempDir other;
    const DaemonProcess alone(other, {"--scene", folder, "--pose", "-1.25,0,0", "--tcp",
                                      "127.0.0.1:0", "--accuracy", "ideal"});
    ASSERT_NE(alone.ready_line(), "") << alone.standard_error();
    EXPECT_EQ(Watcher(alone.port()).latest()[front], 1250U);
    const DaemonProcess lost(other, {"--scene", directory_.path() / "models"});
    EXPECT_EQ(lost.ready_line(), "");
    EXPECT_THAT(lost.standard_error(), HasSubstr("model.config"));
}

TEST_F(SceneEdit, ThatFailsChangesNothingAndSaysWhy) {
    const auto before = daemon_.get("/scene");
    const auto expect = [&](int status, const std::string& word, const std::string& method,
                            const std::string& path, const nlohmann::json& body) {
        const auto answer = ask(method, path, body);
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_THAT(answer.body, HasSubstr(word));
    };
    expect(400, "no/such.sdf", "PUT", "/scene", {{"file", "no/such.sdf"}});
    expect(400, "no such file", "POST", "/scene/models", {{"name", "x"}, {"mesh", "no.stl"}});
    expect(400, "x", "POST", "/scene/models", {{"name", "x"}, {"sdf", "<model"}});
    expect(400, "scale", "POST", "/scene/models",
           {{"name", "x"}, {"mesh", "a.stl"}, {"scale", -1}});
    expect(404, "there is no model \\\"x\\\"", "DELETE", "/scene/models/x", nullptr);
    if (!sanitized) {  // it would report that the child runs out of memory
        const std::string huge = directory_.write("huge.stl", "");
        std::filesystem::resize_file(huge, 900U << 20U);  // sparse: it takes no space on disk
        expect(400, "huge.stl: ", "POST", "/scene/models", {{"name", "x"}, {"mesh", huge}});
    }
    EXPECT_EQ(ask("POST", "/scene/models", cube_at(1.5)).status, 201);
    expect(409, "replace", "POST", "/scene/models", cube_at(1.0));
    EXPECT_EQ(ask("DELETE", "/scene/models/cube").status, 204);
    EXPECT_EQ(daemon_.get("/scene"), before);
}

TEST_F(SceneEdit, ComesInTheOrderOfItsRequests) {
    // All requests come at once. Each finds what the one before has left.
    std::vector<std::future<ControlAnswer>> answers;
    for (int i = 0; i < 20; ++i) {
        auto body = cube_at(1.0);
        body["name"] = "cube " + std::to_string(i);
        answers.push_back(std::async(std::launch::async,
                                     [this, body] { return ask("POST", "/scene/models", body); }));
    }
    for (auto& answer : answers)
        EXPECT_EQ(answer.get().status, 201);
    const auto models = daemon_.get("/scene").at("models");
    const auto cubes = std::count_if(models.begin(), models.end(), [](const auto& model) {
        return model.at("name").template get<std::string>().starts_with("cube");
    });
    EXPECT_EQ(cubes, 20);
}

}  // namespace
}  // namespace scipd::tests
