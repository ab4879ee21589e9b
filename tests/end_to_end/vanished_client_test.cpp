// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A client whose machine vanishes. The robot's machine and the client's are network namespaces with
// a cable between them, which the test pulls out.
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

/// The network of the calling thread.
class Network {
  public:
    static Network of_this_thread() {
        return Network(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
    }
    Network(Network&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Network& operator=(Network&&) = delete;
    ~Network() { ::close(descriptor_); }

    void enter() const { ASSERT_EQ(::setns(descriptor_, CLONE_NEWNET), 0); }
    /// A path for programs that this process starts.
    [[nodiscard]] std::string path() const {
        return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
    }

  private:
    explicit Network(int descriptor) : descriptor_(descriptor) {}

    int descriptor_;
};

bool succeeds(const std::string& command) {
    return std::system((command + " 2>/dev/null").c_str()) == 0;
}

class VanishedClient : public testing::Test {
  protected:
    // The test runs on the robot's machine.
    void SetUp() override {
        const bool allowed = ::unshare(CLONE_NEWNET) == 0;
        if (!allowed) GTEST_SKIP() << "only root may make a network namespace";
        client_ = std::make_unique<Network>(Network::of_this_thread());
        ASSERT_EQ(::unshare(CLONE_NEWNET), 0);
        robot_ = std::make_unique<Network>(Network::of_this_thread());
        if (!succeeds("ip link set lo up && ip link add cable type veth peer name cable netns " +
                      client_->path()) ||
            !succeeds("ip address add 10.9.8.1/24 dev cable && ip link set cable up")) {
            GTEST_SKIP() << "there is no veth, or no ip (iproute2)";
        }
        client_->enter();
        const bool connected =
            succeeds("ip address add 10.9.8.2/24 dev cable && ip link set cable up");
        robot_->enter();
        ASSERT_TRUE(connected);
        daemon_ = std::make_unique<DaemonProcess>(
            directory_,
            Arguments{"--config",
                      directory_.write("robot.yaml", "scene: " + scene("square_room.sdf").string() +
                                                         R"(
robots: {r: {sensors: {s: {model: UST-10LX, tcp: "0.0.0.0:0", link: {dead_after_s: 2}}}}}
)")});
        ASSERT_NE(daemon_->ready_line(), "") << daemon_->standard_error();
    }
    void TearDown() override { outside_.enter(); }

    [[nodiscard]] ScannerWire connect_from_far() const {
        client_->enter();
        ScannerWire wire = ScannerWire::tcp(daemon_->port(), 0, "10.9.8.1");
        robot_->enter();
        return wire;
    }

    void pull_the_cable_out() const {
        client_->enter();
        const bool pulled = succeeds("ip link set cable down");
        robot_->enter();
        ASSERT_TRUE(pulled);
    }

    void expect_the_next_one_in() const {
        ScannerWire wire = ScannerWire::tcp(daemon_->port());
        EXPECT_EQ(wire.ask("VV"), "00");
    }

    Network outside_ = Network::of_this_thread();
    std::unique_ptr<Network> client_;
    std::unique_ptr<Network> robot_;
    TempDir directory_;
    std::unique_ptr<DaemonProcess> daemon_;
};

TEST_F(VanishedClient, LeavesThePortToTheNextOneInMidStream) {
    ScannerWire wire = connect_from_far();
    EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
    (void)wire.next_scan();
    pull_the_cable_out();
    expect_the_next_one_in();
}

TEST_F(VanishedClient, LeavesThePortToTheNextOneWhereItWasSilent) {
    ScannerWire wire = connect_from_far();
    EXPECT_EQ(wire.ask("VV"), "00");
    pull_the_cable_out();
    expect_the_next_one_in();
}

}  // namespace
}  // namespace scipd::tests
