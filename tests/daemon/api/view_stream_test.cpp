// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a page gets to draw over /view: read as a page reads it, against what the sensor's own
// record says.
#include "daemon/api/view_stream.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/fault_text.h"
#include "daemon/api/view_request.h"
#include "daemon/api/world_view.h"
#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/device/scan_loop.h"
#include "daemon/device/staring_sensor.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A frame as a page reads it.
struct SeenFrame {
    explicit SeenFrame(const std::string& bytes) : bytes_(bytes) {
        EXPECT_EQ(bytes.substr(0, 4), "SCV1");
        number = word_at(4);
        const std::size_t header_bytes = word_at(8);
        header = json::parse(bytes.substr(12, header_bytes));
        std::size_t place = 12 + header_bytes;
        for (const json& array : header["arrays"]) {
            EXPECT_EQ(place % 4, 0U) << array;
            const std::string type = array["type"];
            const std::size_t width = type == "u8" ? 1 : type[1] == '1' ? 2 : 4;
            places_[array["name"]] = {place, array["length"]};
            place += (width * array["length"].get<std::size_t>() + 3) / 4 * 4;
        }
        EXPECT_EQ(place, bytes.size());
    }

    template <class Number>
    [[nodiscard]] std::vector<Number> array(const std::string& name) const {
        const auto [place, length] = places_.at(name);
        std::vector<Number> list(length);
        std::memcpy(list.data(), bytes_.data() + place, length * sizeof(Number));
        return list;
    }
    [[nodiscard]] bool has(const std::string& name) const { return places_.contains(name); }

    std::uint32_t number = 0;
    json header;

  private:
    [[nodiscard]] std::uint32_t word_at(std::size_t place) const {
        std::uint32_t word = 0;
        std::memcpy(&word, bytes_.data() + place, 4);
        return word;
    }

    std::string bytes_;
    std::map<std::string, std::pair<std::size_t, std::size_t>> places_;
};

class PageOfTest : public WebSocket {
  public:
    PageOfTest(ViewStream& stream, const ViewStream::Look& look)
        : talk_(stream.open(*this, look)) {}

    void send(std::shared_ptr<const std::string> message) override {
        told.push_back(json::parse(*message));
        unread_.push_back(std::move(message));
    }
    void send_bytes(std::shared_ptr<const std::string> message) override {
        frames.emplace_back(*message);
        unread_.push_back(std::move(message));
    }
    void cut() override { is_cut = true; }
    /// All that it was sent leaves the socket.
    void read() {
        while (!unread_.empty()) {
            unread_.pop_front();
            talk_->left();
        }
    }
    void say(const json& message) { talk_->take(message.dump()); }
    /// Draws all frames that it has.
    void draw() {
        for (const SeenFrame& frame : std::exchange(frames, {}))
            say({{"ack", frame.number}});
    }

    std::vector<json> told;
    std::vector<SeenFrame> frames;
    bool is_cut = false;

  private:
    std::deque<std::shared_ptr<const std::string>> unread_;
    std::unique_ptr<Conversation> talk_;
};

class ViewStreamTest : public testing::Test {
  protected:
    template <class Sensor>
    struct Seen {
        Sensor sensor;
        ScanLoop loop;
        ViewStream::Tap tap;

        Seen(const SensorConfig& config, World& world, Clock& clock, ViewStream& view)
            : sensor("robot", config, 1, world, clock),
              loop(sensor, clock),
              tap(view, "robot/" + config.name, sensor) {}
    };

    ViewStreamTest() {
        world_.replace_backends(one_backend(world_.scene(), {"robot/scanner", "robot/tof"}));
    }

    /// So much of the world's time, and as much of the wall's as a page needs to draw a picture.
    void pass(sim::Time time) {
        std::this_thread::sleep_for(20ms);
        clock_.advance_to(clock_.now() + time);
    }

    PageOfTest page() {
        return {view_, [this] { return now_; }};
    }

    SteppedClock clock_;
    World world_ = wall_world();
    WorldView now_{.version = "1", .scene = world_.scene(), .models = world_.poses_at({})};
    SharedLimits limits_ = std::make_shared<Limits>();
    ViewStream view_{ViewStream::Ways{}, clock_, limits_};
    SensorConfig scanner_ = ideal_sensor();
};

TEST_F(ViewStreamTest, ShowsWhatTheScannerSaysAndWhatIsTrue) {
    Seen<Device> scanner(scanner_, world_, clock_, view_);
    PageOfTest page = this->page();
    page.say({{"scans", {{"robot/scanner", {{"true", true}}}}}});
    pass(60ms);
    ASSERT_THAT(page.frames, SizeIs(1));
    const SeenFrame& frame = page.frames.front();
    const ScanRecord& record = *scanner.sensor.log().latest();
    EXPECT_EQ(frame.header["sensor"], "robot/scanner");
    EXPECT_EQ(frame.header["kind"], "scan");
    EXPECT_EQ(frame.header["beams"], 1081);
    EXPECT_EQ(frame.header["poses_n"], 1);
    EXPECT_NEAR(frame.header["first_angle_rad"], -2.356, 1e-3);
    EXPECT_NEAR(frame.header["step_rad"], 0.25 * M_PI / 180.0, 1e-9);
    EXPECT_EQ(frame.header["first_step"], 0);
    EXPECT_EQ(frame.header["front_step"], 540);
    EXPECT_EQ(frame.header["steps_per_turn"], 1440);
    EXPECT_EQ(frame.header["model"], "UST-10LX");
    EXPECT_EQ(frame.header["serial"], scanner.sensor.profile().serial);
    EXPECT_EQ(frame.header["rpm"], 2400);
    EXPECT_EQ(frame.header["dmin_mm"], 20);     // PP of a recorded UST-10LX
    EXPECT_EQ(frame.header["nearest_mm"], 21);  // its data sheet
    EXPECT_EQ(frame.array<std::uint32_t>("sent_mm").size(), 1081U);
    EXPECT_EQ(frame.array<std::uint32_t>("sent_mm"), record.sent.distance);
    const auto true_m = frame.array<float>("true_m");
    const auto object = frame.array<std::int32_t>("object");
    const auto material = frame.array<std::int16_t>("material");
    int met = 0;
    for (std::size_t beam = 0; beam < true_m.size(); ++beam) {
        const sim::Hit& hit = record.cast->middle(beam);
        met += hit.met() ? 1 : 0;
        ASSERT_EQ(std::isnan(true_m[beam]), !hit.met()) << beam;
        if (!hit.met()) {
            ASSERT_EQ(object[beam], -1);
            ASSERT_EQ(material[beam], -1);
            continue;
        }
        ASSERT_EQ(true_m[beam], hit.range_m);
        ASSERT_EQ(object[beam], static_cast<std::int32_t>(hit.object));
        ASSERT_EQ(frame.header["materials"][static_cast<std::size_t>(material[beam])],
                  record.scene->materials[hit.material].name);
    }
    EXPECT_GT(met, 0);
    EXPECT_LT(met, 1081);
    EXPECT_EQ(frame.array<std::uint8_t>("cause").size(), 1081U);
}

TEST_F(ViewStreamTest, ShowsTheNextFrameWhenThisOneIsDrawn) {
    Seen<Device> scanner(scanner_, world_, clock_, view_);
    PageOfTest page = this->page();
    page.say({{"scans", {{"robot/scanner", json::object()}}}});
    for (int i = 0; i < 5; ++i)
        pass(25ms);
    ASSERT_THAT(page.frames, SizeIs(1)) << "nothing waits while it draws";
    EXPECT_FALSE(page.frames.front().has("true_m"));
    const std::int64_t first = page.frames.front().header["scan"];
    page.draw();
    pass(25ms);
    ASSERT_THAT(page.frames, SizeIs(1));
    EXPECT_GE(page.frames.front().header["scan"], first + 4) << "what it missed is gone";
    page.say({{"ack", 999}});
    pass(50ms);
    EXPECT_THAT(page.frames, SizeIs(1)) << "that was no frame of its own";
}

TEST_F(ViewStreamTest, ShowsEachPageAsMuchAsItCanDraw) {
    Seen<Device> scanner(scanner_, world_, clock_, view_);
    PageOfTest quick = page();
    PageOfTest slow = page();
    for (PageOfTest* page : {&quick, &slow})
        page->say({{"scans", {{"robot/scanner", {{"true", true}}}}}});
    for (int i = 0; i < 4; ++i) {
        pass(25ms);
        EXPECT_THAT(quick.frames, SizeIs(1));
        quick.draw();
    }
    EXPECT_THAT(slow.frames, SizeIs(1));
}

TEST_F(ViewStreamTest, HasNothingCastWhereNoPageLooks) {
    Seen<Device> scanner(scanner_, world_, clock_, view_);
    {
        PageOfTest page = this->page();
        pass(100ms);
        EXPECT_FALSE(scanner.sensor.watched());
        page.say({{"scans", {{"robot/scanner", json::object()}}}});
        EXPECT_TRUE(scanner.sensor.watched());
        page.say({{"scans", json::object()}});
        EXPECT_FALSE(scanner.sensor.watched());
        page.say({{"scans", {{"robot/scanner", json::object()}}}});
    }
    EXPECT_FALSE(scanner.sensor.watched()) << "the page is closed";
    pass(100ms);
    EXPECT_EQ(scanner.sensor.log().latest(), nullptr);
}

TEST_F(ViewStreamTest, ShowsPictures) {
    SensorConfig config = ideal_camera(4, 8.0);
    config.name = "tof";
    Seen<StaringSensor> camera(config, world_, clock_, view_);
    PageOfTest page = this->page();
    page.say({{"scans", {{"robot/tof", {{"true", true}}}}}});
    pass(100ms);
    ASSERT_THAT(page.frames, SizeIs(1));
    const SeenFrame& frame = page.frames.front();
    const auto grid = std::get<sim::PinholeGrid>(camera.sensor.spec().optics);
    EXPECT_EQ(frame.header["kind"], "picture");
    EXPECT_EQ(frame.header["columns"], grid.columns);
    EXPECT_EQ(frame.header["rows"], grid.rows);
    EXPECT_NEAR(frame.header["fov_rad"][0], grid.width_rad, 1e-9);
    EXPECT_THAT(frame.array<float>("range_m"), SizeIs(grid.columns * grid.rows));
    EXPECT_THAT(frame.array<float>("true_m"), SizeIs(grid.columns * grid.rows));
}

TEST_F(ViewStreamTest, TellsWhatItDoesNotUnderstand) {
    PageOfTest page = this->page();
    page.told.clear();
    page.say({{"scans", {{"robot/none", json::object()}}}});
    ASSERT_THAT(page.told, SizeIs(1));
    EXPECT_EQ(page.told[0]["status"], 404);
    page.say({{"dance", true}});
    ASSERT_THAT(page.told, SizeIs(2));
    EXPECT_EQ(page.told[1]["status"], 400);
    EXPECT_EQ(page.told[1]["field"], "dance");
}

TEST_F(ViewStreamTest, TellsPosesWhenSomethingHasMovedAndThePageHasDrawn) {
    now_.scene = sim::SceneBuilder().movable({}).with(sim::Sphere{1}, {}).build();
    now_.models = {{}};
    now_.robots = {{"rescue", {{1, 2, 3}, {1, 0, 0, 0}}}};
    PageOfTest page = this->page();
    ASSERT_THAT(page.told, SizeIs(2));
    EXPECT_EQ(page.told[0], json({{"scene", "1"}}));
    EXPECT_EQ(page.told[1]["robots"]["rescue"]["xyz"], json({1.0, 2.0, 3.0}));
    EXPECT_TRUE(page.told[1]["models"].contains("model 0"));
    page.told.clear();
    now_.robots[0].pose.translation_m.x = 5;
    clock_.advance_to(clock_.now() + 100ms);
    EXPECT_THAT(page.told, IsEmpty()) << "it has not drawn the last ones";
    page.say({{"ack_poses", true}});
    clock_.advance_to(clock_.now() + 100ms);
    ASSERT_THAT(page.told, SizeIs(1));
    EXPECT_EQ(page.told[0]["robots"]["rescue"]["xyz"][0], 5.0);
    EXPECT_THAT(page.told[0]["models"], IsEmpty()) << "nobody has moved it";
    page.say({{"ack_poses", true}});
    clock_.advance_to(clock_.now() + 100ms);
    EXPECT_THAT(page.told, SizeIs(1)) << "nothing has moved";
    now_.version = "2";
    clock_.advance_to(clock_.now() + 100ms);
    ASSERT_THAT(page.told, SizeIs(3));
    EXPECT_EQ(page.told[1], json({{"scene", "2"}}));
    EXPECT_TRUE(page.told[2]["models"].contains("model 0"));
}

std::string fault(std::uint64_t number) {
    return fault_event("robot/scanner", {.number = number,
                                         .id = 7,
                                         .kind = "corrupt",
                                         .what = "acts",
                                         .bytes = std::vector<std::size_t>(3000, 12'345)});
}

/// The numbers of the faults in a message.
std::vector<std::uint64_t> numbers(const json& message) {
    std::vector<std::uint64_t> numbers;
    for (const json& event : message.at("faults"))
        numbers.push_back(event.at("n"));
    return numbers;
}

TEST_F(ViewStreamTest, TellsFaultsOnPurpose) {
    PageOfTest page = this->page();
    page.read();
    page.told.clear();
    view_.tell_fault(fault(1));
    ASSERT_THAT(page.told, SizeIs(1)) << "at once";
    const json& event = page.told[0]["faults"].at(0);
    EXPECT_EQ(event["sensor"], "robot/scanner");
    EXPECT_EQ(event["kind"], "corrupt");
    EXPECT_EQ(event["bytes_n"], 3000);
    EXPECT_LT(event.dump().size(), 300U) << "not each of the bytes";
    page.read();
    for (std::uint64_t number = 2; number < 1000; ++number)
        view_.tell_fault(fault(number));
    EXPECT_THAT(page.told, SizeIs(1));
    clock_.advance_to(clock_.now() + 40ms);
    ASSERT_THAT(page.told, SizeIs(2)) << "many are one message";
    EXPECT_THAT(numbers(page.told[1]), SizeIs(64));
    EXPECT_EQ(numbers(page.told[1]).back(), 999U);
}

TEST_F(ViewStreamTest, KeepsTheLatestFaultsForAPageThatDoesNotRead) {
    PageOfTest deaf = page();
    PageOfTest other = page();
    for (PageOfTest* page : {&deaf, &other})
        page->told.clear();
    for (std::uint64_t number = 1; number <= 100; ++number) {
        other.read();
        view_.tell_fault(fault(number));
        clock_.advance_to(clock_.now() + 40ms);
    }
    EXPECT_THAT(other.told, SizeIs(100));
    EXPECT_THAT(deaf.told, IsEmpty()) << "nothing queues for it";
    deaf.read();
    ASSERT_THAT(deaf.told, SizeIs(16));
    EXPECT_EQ(numbers(deaf.told.back()), std::vector<std::uint64_t>{100});
    EXPECT_FALSE(deaf.is_cut);
}

TEST_F(ViewStreamTest, CutsAPageThatReadsNothingForLong) {
    PageOfTest deaf = page();
    PageOfTest other = page();
    for (int i = 0; i < 9; ++i) {
        other.read();
        clock_.advance_to(clock_.now() + 1s);
    }
    EXPECT_FALSE(deaf.is_cut);
    other.read();
    clock_.advance_to(clock_.now() + 2s);
    EXPECT_TRUE(deaf.is_cut);
    other.read();
    clock_.advance_to(clock_.now() + 20s);
    EXPECT_FALSE(other.is_cut) << "it has nothing to read";
}

TEST_F(ViewStreamTest, HasOneBoundForAllPages) {
    Seen<Device> scanner(scanner_, world_, clock_, view_);
    const auto look = [&] {
        auto page = std::make_unique<PageOfTest>(view_, [this] { return now_; });
        page->read();
        page->say({{"scans", {{"robot/scanner", {{"true", true}}}}}});
        pass(50ms);
        return page;
    };
    auto deaf = look();
    ASSERT_THAT(deaf->frames, SizeIs(1));
    LimitValues values;
    values[Limit::websocket_queue_bytes] = 50'000;  // two frames
    limits_->set(values);
    auto also_deaf = look();
    ASSERT_THAT(also_deaf->frames, SizeIs(1));
    auto good = look();
    EXPECT_THAT(good->frames, IsEmpty()) << "there is no room";
    EXPECT_GT(limits_->refused(Limit::websocket_queue_bytes), 0U);
    for (int i = 0; i < 25; ++i)
        pass(50ms);
    EXPECT_TRUE(deaf->is_cut && also_deaf->is_cut) << "others need what they hold";
    EXPECT_FALSE(good->is_cut);
    deaf.reset();
    also_deaf.reset();
    for (int i = 0; i < 3; ++i)
        pass(50ms);
    EXPECT_THAT(good->frames, SizeIs(1));
}

TEST(ViewFrame, KeepsUpWithARobotThatMoves) {
    sim::Scan scan;
    scan.hits.resize(1000);
    for (int i = 0; i < 1000; ++i)
        scan.world_from_sensor.push_back({{1e6 + 0.001 * i, 0, 0}, {1, 0, 0, 0}});
    ScanRecord record;
    record.cast = std::make_shared<const sim::Scan>(std::move(scan));
    record.scene = std::make_shared<const sim::Scene>();
    record.steps_per_turn = 1440;
    const SeenFrame frame(view_frame("r/s", record, {}, ViewDepth::sent));
    const auto poses = frame.array<float>("origin_pose");
    const std::size_t count = frame.header["poses_n"];
    ASSERT_EQ(poses.size(), 7 * count);
    const double middle = frame.header["pose"]["xyz"][0];
    for (std::size_t beam = 0; beam < 1000; ++beam) {
        const float x = poses[7 * (beam * count / 1000)];
        EXPECT_NEAR(middle + static_cast<double>(x), 1e6 + 0.001 * static_cast<double>(beam), 0.01);
    }
}

TEST(ViewFrame, TellsWhatReturnedTheLight) {
    // Glass at 2 m and a wall at 3 m: the first beam reads the wall, the second the glass, and the
    // third beam has no echo.
    sim::Scan scan;
    scan.world_from_sensor.push_back({{0, 0, 0}, {1, 0, 0, 0}});
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float read_m : {2.98F, 2.01F, infinite}) {
        scan.hits.push_back({.range_m = 2.0F, .cos_incidence = 1.0F, .object = 0});
        scan.readings.push_back({.range_m = read_m});
        if (read_m < infinite) {
            scan.echoes.add({.range_m = 2.0F, .object = 0, .material = 0});
            scan.echoes.add({.range_m = 3.0F, .object = 0, .material = 1});
        }
        scan.echoes.finish_beam();
    }
    ScanRecord record;
    record.cast = std::make_shared<const sim::Scan>(scan);
    sim::Scene scene;
    scene.materials = {{.name = "glass"}, {.name = "wall"}};
    record.scene = std::make_shared<const sim::Scene>(std::move(scene));
    record.steps_per_turn = 1440;
    const SeenFrame frame(view_frame("r/s", record, {}, ViewDepth::truth));
    EXPECT_THAT(frame.array<float>("returned_m"), ElementsAre(3.0F, 2.0F, 2.0F));
    EXPECT_THAT(frame.array<float>("true_m"), ElementsAre(2.0F, 2.0F, 2.0F));
    EXPECT_EQ(frame.header["materials"], json({"glass", "wall"}));
    EXPECT_THAT(frame.array<std::int16_t>("returned_material"), ElementsAre(1, 0, 0));
}

TEST(ViewRequest, IsReadWithCare) {
    for (const char* text :
         {"", "[]", "x", R"({"scans":1})", R"({"scans":{"a":1}})", R"({"scans":{"a":{"true":1}}})",
          R"({"ack":-1})", R"({"ack":4294967299})", R"({"ack":"1"})", R"({"ack_poses":1})",
          R"({"other":1})", R"({"scans":{"a":{"echoes":true}}})"})
        EXPECT_FALSE(parse_view_request(text)) << text;
    EXPECT_EQ(parse_view_request(R"({"ack_poses":1})").error().why, "ack_poses must be true");
    EXPECT_EQ(parse_view_request(R"({"scans":{"a":{"echoes":true}}})").error().why,
              "scans.a: the key 'echoes' is unknown; there is \"true\"");
    const auto all =
        parse_view_request(R"({"scans":{"a/b":{"true":true}},"ack":3,"ack_poses":true})");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->scans->at("a/b"), ViewDepth::truth);
    EXPECT_EQ(all->ack, 3U);
    EXPECT_TRUE(all->ack_poses);
}

}  // namespace
}  // namespace scipd::daemon
