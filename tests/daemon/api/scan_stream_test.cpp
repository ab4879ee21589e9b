// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// /stream with many sensors that all measure at the same instants, to clients that read and to one
// that does not.
#include "daemon/api/scan_stream.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/scan_loop.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/faults/fault_log.h"
#include "tests/daemon/device/ideal_camera.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// One client, that holds what it is sent until it reads.
class Client : public WebSocket {
  public:
    explicit Client(ScanStream& stream) : talk_(stream.subscribe("", *this)) {}

    void send(std::shared_ptr<const std::string> message) override {
        unread_.push_back(std::move(message));
    }
    void send_bytes(std::shared_ptr<const std::string>) override {}
    void cut() override {}

    /// All that there is.
    std::vector<std::shared_ptr<const std::string>> take_all() {
        std::vector<std::shared_ptr<const std::string>> all;
        while (!unread_.empty()) {
            all.push_back(std::move(unread_.front()));
            unread_.pop_front();
            talk_->left();
        }
        return all;
    }
    /// How many messages of each sensor have come since the last call.
    std::map<std::string, std::uint64_t> read() {
        std::map<std::string, std::uint64_t> heard;
        for (const auto& message : take_all())
            ++heard[nlohmann::json::parse(*message).at("sensor").get<std::string>()];
        return heard;
    }

  private:
    std::deque<std::shared_ptr<const std::string>> unread_;
    std::unique_ptr<Conversation> talk_;
};

class ScanStreamTest : public testing::Test {
  protected:
    struct Camera {
        std::string name;
        StaringSensor sensor;
        ScanLoop loop;
        ScanStream::Tap tap;

        Camera(const SensorConfig& config, World& world, Clock& clock, ScanStream& stream)
            : name("robot/" + config.name),
              sensor("robot", config, 1, world, clock),
              loop(sensor, clock),
              tap(stream, name, sensor) {}
    };

    /// Cameras that all measure every 40 ms.
    void add(int count, int columns) {
        std::vector<SensorConfig> configs(static_cast<std::size_t>(count),
                                          ideal_camera(columns, 8.0));
        std::vector<std::string> names;
        for (std::size_t i = 0; i < configs.size(); ++i) {
            configs[i].name = std::string("c").append(std::to_string(i));
            names.push_back("robot/" + configs[i].name);
        }
        world_.replace_backends(one_backend(world_.scene(), names));
        for (const SensorConfig& config : configs)
            cameras_.push_back(std::make_unique<Camera>(config, world_, clock_, stream_));
    }
    void instants(int count) { clock_.advance_to(clock_.now() + count * 40ms); }

    SteppedClock clock_;
    World world_ = wall_world();
    ScanStream stream_;
    FaultLog log_;
    std::vector<std::unique_ptr<Camera>> cameras_;
};

TEST_F(ScanStreamTest, IsHeardOfHoweverManyMeasureAtOneInstant) {
    add(40, 1);
    Client client(stream_);
    for (int round = 0; round < 3; ++round) {
        instants(2);
        const auto heard = client.read();
        ASSERT_EQ(heard.size(), 40U);
        for (const auto& [sensor, messages] : heard)
            EXPECT_EQ(messages, 2U) << sensor;
    }
    for (const auto& camera : cameras_)
        EXPECT_EQ(camera->tap.lost(), 0U);
}

TEST_F(ScanStreamTest, LosesOfAllAlikeForOneWhoDoesNotRead) {
    add(20, 1);
    Client slow(stream_);
    Client quick(stream_);
    for (int i = 0; i < 50; ++i) {
        instants(1);
        EXPECT_EQ(quick.read().size(), 20U);
    }
    const auto heard = slow.read();
    ASSERT_EQ(heard.size(), 20U);
    for (const auto& camera : cameras_) {
        const std::uint64_t messages = heard.at(camera->name);
        EXPECT_EQ(messages + camera->tap.lost(), 50U) << camera->name;
        EXPECT_GE(messages, 16U) << camera->name;
        EXPECT_LE(messages, 17U) << camera->name << ": with one that was on its way";
    }
    instants(16);
    for (const auto& [sensor, messages] : slow.read())
        EXPECT_EQ(messages, 16U) << sensor << ": there is room again";
}

TEST_F(ScanStreamTest, AnswersThoseWhoWantOneSensorWithThatOne) {
    add(3, 1);
    struct Reader : WebSocket {
        void send_bytes(std::shared_ptr<const std::string>) override {}
        void cut() override {}
        void send(std::shared_ptr<const std::string> message) override {
            sensors.push_back(nlohmann::json::parse(*message).at("sensor"));
        }
        std::vector<std::string> sensors;
    } reader;
    const auto talk = stream_.subscribe("robot/c1", reader);
    for (std::size_t scan = 1; scan <= 3; ++scan) {
        instants(1);
        EXPECT_EQ(reader.sensors, std::vector<std::string>(scan, "robot/c1"));
        talk->left();
    }
    EXPECT_EQ(cameras_[1]->tap.lost(), 0U);
    Client all(stream_);
    talk->left();
    // Camera 1 measures first, since it was watched already: one of its messages is on the way to
    // both.
    instants(20);
    EXPECT_EQ(cameras_[0]->tap.lost(), 20U - 16U);
    EXPECT_EQ(cameras_[1]->tap.lost(), 2 * (20U - 1U - 16U));
    EXPECT_EQ(cameras_[2]->tap.lost(), 20U - 16U);
}

TEST_F(ScanStreamTest, TellsOfFaultsBesideTheScans) {
    add(2, 1);
    cameras_[0]->tap.follow(log_);
    const auto inject = [&] {
        log_.add({.id = 4,
                  .kind = "freeze",
                  .what = "begins",
                  .scan = 7,
                  .told = 250ms,
                  .bytes = {5, 6, 70},
                  .steps = {}});
    };
    inject();
    Client client(stream_);
    struct Reader : WebSocket {
        void send_bytes(std::shared_ptr<const std::string>) override {}
        void cut() override {}
        void send(std::shared_ptr<const std::string>) override { ++messages; }
        int messages = 0;
    } of_other;
    const auto talk = stream_.subscribe("robot/c1", of_other);
    inject();
    const auto messages = client.take_all();
    ASSERT_EQ(messages.size(), 1U) << "what was before is in the log alone";
    EXPECT_EQ(nlohmann::json::parse(*messages[0]), nlohmann::json::parse(R"({"fault":{
        "sensor":"robot/c0","n":2,"id":4,"kind":"freeze","what":"begins","scan":7,
        "request":null,"time_s":0.25,"bytes_n":3,"steps_n":0}})"));
    EXPECT_EQ(of_other.messages, 0);
    instants(1);
    EXPECT_EQ(client.read(),
              (std::map<std::string, std::uint64_t>{{"robot/c0", 1}, {"robot/c1", 1}}));
    EXPECT_EQ(of_other.messages, 1);
}

TEST_F(ScanStreamTest, LosesNoScanForManyFaults) {
    add(1, 1);
    cameras_[0]->tap.follow(log_);
    Client slow(stream_);
    instants(10);
    for (int i = 0; i < 100; ++i)
        log_.add({.kind = "stall", .what = "ends", .bytes = {}, .steps = {}});
    std::size_t scans = 0;
    for (const auto& message : slow.take_all())
        scans += nlohmann::json::parse(*message).contains("sensor") ? 1 : 0;
    EXPECT_EQ(scans, 10U);
    EXPECT_EQ(cameras_[0]->tap.lost(), 0U);
}

// Its own thread waits for something else, while the sensors go on.
TEST_F(ScanStreamTest, HasOnlySoMuchWaitForItsThread) {
    std::vector<ScanStream::Ways::Call> waiting;
    ScanStream busy(std::make_shared<Limits>(),
                    {.to_stream = [&](auto call) { waiting.push_back(std::move(call)); }});
    SensorConfig config = ideal_camera(1, 8.0);
    config.name = "c0";
    world_.replace_backends(one_backend(world_.scene(), {"robot/c0"}));
    Camera camera(config, world_, clock_, busy);
    camera.tap.follow(log_);
    Client client(busy);
    const auto go_on = [&] {
        for (const auto& call : std::exchange(waiting, {}))
            call();
    };
    instants(50);
    EXPECT_EQ(waiting.size(), 16U);
    EXPECT_EQ(camera.tap.lost(), 50U - 16U);
    go_on();
    EXPECT_EQ(client.read().at("robot/c0"), 16U);
    instants(2);
    go_on();
    EXPECT_EQ(client.read().at("robot/c0"), 2U) << "there is room again";
    for (int i = 0; i < 10'000; ++i)
        log_.add({.kind = "corrupt", .what = "acts", .bytes = {1}, .steps = {}});
    EXPECT_LE(waiting.size(), 1000U);
    EXPECT_EQ(camera.tap.lost(), 50U - 16U) << "no scan";
    go_on();
}

TEST_F(ScanStreamTest, LeavesALogAlone) {
    add(1, 1);
    cameras_[0]->tap.follow(log_);
    Client client(stream_);
    cameras_.clear();
    log_.add({.kind = "stall", .what = "ends", .bytes = {}, .steps = {}});
    EXPECT_TRUE(client.take_all().empty());
}

// Nine megabytes an instant, and the clients begin at different ones.
TEST_F(ScanStreamTest, KeepsNoMoreThanItsBoundOfLargePicturesForAllClients) {
    add(6, 200'000);
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 4; ++i) {
        clients.push_back(std::make_unique<Client>(stream_));
        instants(4);
    }
    std::set<std::shared_ptr<const std::string>> kept;
    for (const auto& client : clients) {
        for (const auto& message : client->take_all())
            kept.insert(message);
    }
    std::size_t bytes = 0;
    std::map<std::string, int> heard;
    for (const auto& message : kept) {
        bytes += message->size();
        ++heard[message->substr(0, message->find(','))];  // {"sensor":"robot/c0"
    }
    const std::size_t one = (*kept.begin())->size();
    ASSERT_GT(one, 1'000'000U);
    // Besides, one is on its way to each client.
    EXPECT_LT(bytes, (std::size_t{64} << 20U) + (clients.size() + 1) * one * 11 / 10);
    EXPECT_EQ(heard.size(), 6U);
    for (const auto& [sensor, messages] : heard)
        EXPECT_GE(messages, 2) << sensor;
}

}  // namespace
}  // namespace scipd::daemon
