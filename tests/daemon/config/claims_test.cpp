// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/claims.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "daemon/config/values.h"
#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

/// A listener as the daemon has them.
class Listener {
  public:
    Listener(Transport transport, const Address& address) {
        const bool v6 = address.host.find(':') != std::string::npos;
        const bool is_tcp = transport == Transport::tcp;
        socket_ = ::socket(v6 ? AF_INET6 : AF_INET, is_tcp ? SOCK_STREAM : SOCK_DGRAM, 0);
        const int on = 1;
        if (is_tcp) ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
        v6 ? bind_v6(address) : bind_v4(address);
        if (bound_ && is_tcp) bound_ = ::listen(socket_, 1) == 0;
    }
    ~Listener() { ::close(socket_); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    [[nodiscard]] bool bound() const { return bound_; }
    [[nodiscard]] std::uint16_t port() const {
        sockaddr_in6 taken{};  // the port of IPv4 is at the same place
        socklen_t size = sizeof(taken);
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&taken), &size);
        return ntohs(taken.sin6_port);
    }

  private:
    void bind_v4(const Address& address) {
        sockaddr_in wanted{};
        wanted.sin_family = AF_INET;
        wanted.sin_port = htons(address.port);
        inet_pton(AF_INET, address.host.c_str(), &wanted.sin_addr);
        bound_ = ::bind(socket_, reinterpret_cast<sockaddr*>(&wanted), sizeof(wanted)) == 0;
    }
    void bind_v6(const Address& address) {
        sockaddr_in6 wanted{};
        wanted.sin6_family = AF_INET6;
        wanted.sin6_port = htons(address.port);
        inet_pton(AF_INET6, address.host.c_str(), &wanted.sin6_addr);
        bound_ = ::bind(socket_, reinterpret_cast<sockaddr*>(&wanted), sizeof(wanted)) == 0;
    }

    int socket_ = -1;
    bool bound_ = false;
};

/// On any of a few ports: others on this machine have some, too.
bool can_be_bound_beside(Transport transport, Address one, Address other) {
    for (int i = 0; i < 5; ++i) {
        const Listener first(transport, one);
        other.port = first.port();
        if (first.bound() && Listener(transport, other).bound()) return true;
    }
    return false;
}

TEST(Claims, AreOfTheAddressesThatTheKernelDoesNotGiveTwice) {
    const bool has_v6 = Listener(Transport::tcp, {"::1", 0}).bound();
    for (const char* one : {"127.0.0.1", "127.0.0.2", "0.0.0.0", "::1", "::", "::ffff:127.0.0.1"}) {
        for (const char* other :
             {"127.0.0.1", "127.0.0.2", "0.0.0.0", "::1", "0:0::1", "::", "::ffff:127.0.0.1"}) {
            if (!has_v6 && (one[0] == ':' || std::string(other).find(':') != std::string::npos))
                continue;
            EXPECT_TRUE(exclude_each_other({one, 7}, {other, 7}) ==
                        !can_be_bound_beside(Transport::tcp, {one}, {other}))
                << one << " " << other;
            EXPECT_TRUE(exclude_each_other({one, 7}, {other, 7}) ==
                        !can_be_bound_beside(Transport::udp, {one}, {other}))
                << one << " " << other;
            EXPECT_FALSE(exclude_each_other({one, 7}, {other, 8}));
        }
    }
}

class ClaimsTest : public ConfigFixture {};

TEST_F(ClaimsTest, AreOfAddresses) {
    std::filesystem::permissions(dir_.write("token", "0123456789abcdef"),
                                 std::filesystem::perms(0600));
    EXPECT_THAT(
        faults(R"(scene: room.sdf
http: {listen: 0.0.0.0:1002, token_file: token}
robots:
  a:
    poses: udp:127.0.0.1:1001
    sensors:
      one: {model: UST-10LX, tcp: 127.0.0.1:1001}
      two: {model: UST-10LX, tcp: 127.0.0.1:1002}
  b:
    poses: {from: udp:127.0.0.1:1001}
    sensors:
      one: {model: UST-10LX, tcp: "[::]:1001"}
  c:
    poses: udp:127.0.0.1:0
    sensors:
      one: {model: UST-10LX, pty: auto}
  d:
    poses: udp:127.0.0.1:0
    sensors:
      one: {model: UST-10LX, pty: auto}
)"),
        ElementsAre("rig.yaml:8: robots.a.sensors.two.tcp: 127.0.0.1:1002 is taken by http, "
                    "which has 0.0.0.0:1002; use another",
                    "rig.yaml:10: robots.b.poses.from: 127.0.0.1:1001 is taken by "
                    "robots.a.poses; use another",
                    "rig.yaml:12: robots.b.sensors.one.tcp: [::]:1001 is taken by "
                    "robots.a.sensors.one.tcp, which has 127.0.0.1:1001; use another"));
}

TEST_F(ClaimsTest, AreOfFilesHoweverTheyAreSpelt) {
    fs::create_directory(dir_.path() / "here");
    fs::create_directory_symlink("here", dir_.path() / "there");
    EXPECT_THAT(faults(R"(scene: room.sdf
control: here/socket
robots:
  a:
    sensors:
      one: {model: UST-10LX, pty: here/tty}
      two: {model: UST-10LX, pty: there/tty}
      three: {model: UST-10LX, pty: there/socket}
)"),
                ElementsAre("rig.yaml:7: robots.a.sensors.two.pty: here/tty is taken by "
                            "robots.a.sensors.one.pty; use another",
                            "rig.yaml:8: robots.a.sensors.three.pty: here/socket is taken by "
                            "control; use another"));
}

TEST_F(ClaimsTest, LetNoFileBeAFolderOfAnother) {
    const std::string here = dir_.path().string();
    EXPECT_THAT(faults(R"(scene: room.sdf
control: c.sock
robots:
  a:
    sensors:
      one: {model: UST-10LX, pty: tty}
      two: {model: UST-10LX, pty: tty/u}
      three: {model: UST-10LX, pty: c.sock/u}
      four: {model: UST-10LX, pty: tty2}
)"),
                ElementsAre("rig.yaml:7: robots.a.sensors.two.pty: tty/u and tty of "
                            "robots.a.sensors.one.pty cannot both be: one is a folder of the "
                            "other; use another",
                            "rig.yaml:8: robots.a.sensors.three.pty: c.sock/u and c.sock of "
                            "control cannot both be: one is a folder of the other; use another"));
}

TEST_F(ClaimsTest, AreOfTheNamesThatScipdChooses) {
    setenv("XDG_RUNTIME_DIR", dir_.path().c_str(), 1);
    unsetenv("RUNTIME_DIRECTORY");
    EXPECT_THAT(faults(R"(scene: room.sdf
robots:
  a-b:
    sensors:
      c: {model: UST-10LX, pty: auto}
      d: {model: UST-10LX, pty: scipd/control.sock}
      e: {model: UST-10LX, pty: scipd/a-b-c}
  a:
    sensors:
      b-c: {model: UST-10LX, pty: auto}
)"),
                ElementsAre("rig.yaml:6: robots.a-b.sensors.d.pty: scipd/control.sock is taken "
                            "by control; use another",
                            "rig.yaml:7: robots.a-b.sensors.e.pty: scipd/a-b-c is taken by "
                            "robots.a-b.sensors.c.pty; use another",
                            "rig.yaml:10: robots.a.sensors.b-c.pty: scipd/a-b-c is taken by "
                            "robots.a-b.sensors.c.pty; use another"));
    // The default is nobody's where there is another.
    EXPECT_THAT(faults("scene: room.sdf\ncontrol: other.sock\nrobots: {r: {sensors: {s: {model: "
                       "UST-10LX, pty: scipd/control.sock}}}}"),
                IsEmpty());
    unsetenv("XDG_RUNTIME_DIR");
}

}  // namespace
}  // namespace scipd::daemon
