// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A small server of WebSockets stands for rosbridge.
#include <chrono>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/bridges/bus.h"
#include "daemon/bridges/ros_json.h"
#include "tests/daemon/bridges/heard_by.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using scipd::tests::Kept;
using ::testing::HasSubstr;

namespace beast = boost::beast;
using boost::asio::ip::tcp;

constexpr const char* ros2_odometry =
    R"({"op":"publish","topic":"/odom","msg":{"header":{"stamp":{"sec":12,"nanosec":500000000},)"
    R"("frame_id":"odom"},"child_frame_id":"base_link","pose":{"pose":{"position":{"x":1.0,)"
    R"("y":2.0,"z":0.5},"orientation":{"x":0,"y":0,"z":0,"w":1}},"covariance":[null,0.0]},)"
    R"("twist":{"twist":{"linear":{"x":1,"y":0,"z":0},"angular":{"x":0,"y":0,"z":0.25}},)"
    R"("covariance":[]}}})";

/// One connection after the other.
class Server {
  public:
    using Socket = beast::websocket::stream<tcp::socket>;

    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    Socket accept() {
        tcp::socket peer(io_);
        acceptor_.accept(peer);
        Socket socket(std::move(peer));
        socket.accept();
        return socket;
    }

    static std::string read(Socket& socket) {
        beast::flat_buffer buffer;
        socket.read(buffer);
        return beast::buffers_to_string(buffer.data());
    }

    static void write(Socket& socket, const std::string& text) {
        socket.write(boost::asio::buffer(text));
    }

  private:
    boost::asio::io_context io_;
    tcp::acceptor acceptor_{io_, {boost::asio::ip::make_address("127.0.0.1"), 0}};
};

const Heard& heard_in(const RosbridgeMessage& message) {
    return std::get<RosbridgePublish>(message).heard;
}

TEST(RosJson, ReadsOdometryWithNullsInItsCovariance) {
    const auto said = read_rosbridge(ros2_odometry);
    ASSERT_TRUE(said) << said.error().why;
    const Heard& heard = heard_in(*said);
    EXPECT_EQ(heard.type, "nav_msgs/Odometry");
    EXPECT_EQ(heard.poses[0].time, 12500ms);
    EXPECT_EQ(heard.poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 0.5));
    EXPECT_EQ(heard.poses[0].velocity->angular_radps.z, 0.25);
}

TEST(RosJson, RefusesAPlaceThatIsNull) {
    std::string text = ros2_odometry;
    text.replace(text.find("1.0"), 3, "null");
    const auto said = read_rosbridge(text);
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().why, "/odom: pose must lie within 1e7 m of the origin");
}

TEST(RosJson, ReadsStampsAndTransformsOfRos1) {
    const auto said = read_rosbridge(
        R"({"op":"publish","topic":"/tf","msg":{"transforms":[{"header":{"seq":1,"stamp":)"
        R"({"secs":3,"nsecs":1},"frame_id":"/odom"},"child_frame_id":"/base_link","transform":)"
        R"({"translation":{"x":1,"y":0,"z":0},"rotation":{"x":0,"y":0,"z":0,"w":1}}}]}})");
    ASSERT_TRUE(said) << said.error().why;
    EXPECT_EQ(heard_in(*said).type, "tf2_msgs/TFMessage");
    EXPECT_EQ(heard_in(*said).poses[0].time, 3s + 1ns);
    EXPECT_EQ(heard_in(*said).poses[0].child, "/base_link");
}

TEST(RosJson, TellsMessagesApartByWhatTheyHave) {
    const std::string pose =
        R"({"position":{"x":1,"y":0,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}})";
    const auto type_of = [](const std::string& message) {
        const auto said = read_rosbridge(R"({"op":"publish","topic":"/x","msg":)" + message + '}');
        return said ? heard_in(*said).type : said.error().why;
    };
    EXPECT_EQ(type_of(R"({"header":{},"pose":)" + pose + '}'), "geometry_msgs/PoseStamped");
    EXPECT_EQ(type_of(R"({"header":{},"pose":{"pose":)" + pose + "}}"),
              "geometry_msgs/PoseWithCovarianceStamped");
    EXPECT_EQ(type_of(R"({"clock":{"sec":1,"nanosec":0}})"), "rosgraph_msgs/Clock");
    EXPECT_EQ(type_of(R"({"ranges":[]})"), "/x: it holds no pose that scipd can read");
    EXPECT_TRUE(std::holds_alternative<RosbridgeOther>(*read_rosbridge(R"({"op":"pong"})")));
    EXPECT_FALSE(read_rosbridge("[1"));
}

TEST(Rosbridge, SubscribesAndHearsAndComesBack) {
    Server server;
    Kept kept;
    const auto bus = listen_to_rosbridge("localhost", server.port(),
                                         {.topic = "/odom", .fixed = {}, .clock = "/clock"}, kept);
    {
        auto socket = server.accept();
        EXPECT_EQ(Server::read(socket), R"({"id":"/odom","op":"subscribe","topic":"/odom"})");
        EXPECT_THAT(Server::read(socket), HasSubstr("/clock"));
        Server::write(socket, ros2_odometry);
        Server::write(socket, "damaged");
        ASSERT_TRUE(kept.wait_for(1, 1));
    }
    ASSERT_TRUE(kept.wait_for_trouble());
    EXPECT_THAT(kept.trouble(), HasSubstr("no rosbridge at localhost:"));
    auto again = server.accept();
    EXPECT_THAT(Server::read(again), HasSubstr("/odom"));
    Server::write(again, ros2_odometry);
    ASSERT_TRUE(kept.wait_for(2, 1));
    EXPECT_EQ(kept.trouble(), "");
}

TEST(Rosbridge, AsksAgainForATopicThatIsNotThereYet) {
    Server server;
    Kept kept;
    const auto bus = listen_to_rosbridge("127.0.0.1", server.port(), {.topic = "/odom"}, kept);
    auto socket = server.accept();
    EXPECT_THAT(Server::read(socket), HasSubstr("/odom"));
    Server::write(socket,
                  R"({"op":"status","level":"error","id":"/odom","msg":"Cannot infer type"})");
    ASSERT_TRUE(kept.wait_for_trouble());
    EXPECT_EQ(kept.trouble(), "rosbridge refuses /odom: Cannot infer type");
    EXPECT_THAT(Server::read(socket), HasSubstr("/odom"));
    Server::write(socket, ros2_odometry);
    ASSERT_TRUE(kept.wait_for(1));
    EXPECT_EQ(kept.trouble(), "");
}

TEST(Rosbridge, EndsWhereNobodyAnswers) {
    Kept kept;
    const auto bus = listen_to_rosbridge("127.0.0.1", 1, {.topic = "/odom"}, kept);
    ASSERT_TRUE(kept.wait_for_trouble());
    EXPECT_THAT(kept.trouble(), HasSubstr("no rosbridge at 127.0.0.1:1: "));
}

}  // namespace
}  // namespace scipd::daemon
