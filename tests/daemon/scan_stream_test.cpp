// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// /stream with many sensors that all measure at the same instants, to clients that read and to one
// that does not.
#include "daemon/control/scan_stream.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/device/scan_loop.h"
#include "daemon/device/stepped_clock.h"
#include "tests/daemon/ideal_camera.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Holds what it is sent until it is read.
class Socket : public WebSocket {
  public:
    void send(std::shared_ptr<const std::string> message) override {
        unread_.push_back(std::move(message));
    }
    [[nodiscard]] std::size_t queued() const override { return unread_.size(); }

    [[nodiscard]] std::size_t bytes() const {
        std::size_t bytes = 0;
        for (const auto& message : unread_)
            bytes += message->size();
        return bytes;
    }
    /// How many messages there were of each sensor.
    std::map<std::string, int> read() {
        std::map<std::string, int> heard;
        for (const auto& message : unread_)
            ++heard[nlohmann::json::parse(*message).at("sensor").get<std::string>()];
        unread_.clear();
        return heard;
    }

  private:
    std::vector<std::shared_ptr<const std::string>> unread_;
};

class ScanStreamTest : public testing::Test {
  protected:
    struct Camera {
        StaringSensor sensor;
        ScanLoop loop;
        ScanStream::Tap tap;

        Camera(const SensorConfig& config, World& world, Clock& clock, ScanStream& stream)
            : sensor("robot", config, 1, world, clock),
              loop(sensor, clock),
              tap(stream, "robot/" + config.name, sensor) {}
    };

    /// Cameras that all measure every 40 ms.
    void add(int count, int columns) {
        std::vector<SensorConfig> configs(static_cast<std::size_t>(count),
                                          ideal_camera(columns, 8.0));
        std::vector<std::string> names;
        for (std::size_t i = 0; i < configs.size(); ++i) {
            configs[i].name = "c" + std::to_string(i);
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
    std::vector<std::unique_ptr<Camera>> cameras_;
    Socket socket_;
};

TEST_F(ScanStreamTest, IsHeardOfHoweverManyMeasureAtOneInstant) {
    add(40, 1);
    const auto talk = stream_.subscribe("", socket_);
    for (int round = 0; round < 3; ++round) {
        instants(2);
        const auto heard = socket_.read();
        ASSERT_EQ(heard.size(), 40U);
        for (const auto& [sensor, messages] : heard)
            EXPECT_EQ(messages, 2) << sensor;
    }
    for (const auto& camera : cameras_)
        EXPECT_EQ(camera->tap.lost(), 0U);
}

TEST_F(ScanStreamTest, LosesOfAllAlikeForOneWhoDoesNotRead) {
    add(20, 1);
    Socket quick;
    const auto slow_talk = stream_.subscribe("", socket_);
    const auto quick_talk = stream_.subscribe("", quick);
    for (int i = 0; i < 50; ++i) {
        instants(1);
        EXPECT_EQ(quick.read().size(), 20U);
    }
    for (const auto& camera : cameras_)
        EXPECT_EQ(camera->tap.lost(), 50U - 16U);
    for (const auto& [sensor, messages] : socket_.read())
        EXPECT_EQ(messages, 16) << sensor;
    instants(16);
    EXPECT_EQ(socket_.read().size(), 20U) << "there is room again";
    EXPECT_EQ(cameras_[0]->tap.lost(), 50U - 16U);
}

// Sixteen of each would be 150 MB.
TEST_F(ScanStreamTest, QueuesNoMoreThanItsBoundOfLargePictures) {
    add(6, 200'000);
    const auto talk = stream_.subscribe("", socket_);
    instants(1);
    const std::size_t one_of_each = socket_.bytes();
    ASSERT_GT(one_of_each, std::size_t{4'000'000});
    instants(20);
    EXPECT_LT(socket_.bytes(), (std::size_t{64} << 20U) + one_of_each);
    const auto heard = socket_.read();
    ASSERT_EQ(heard.size(), 6U);
    for (const auto& [sensor, messages] : heard)
        EXPECT_GE(messages, 2) << sensor;
}

}  // namespace
}  // namespace scipd::daemon
