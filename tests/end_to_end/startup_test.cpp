// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"
#include "tests/support/udp_sender.h"

namespace scipd::tests {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

class Startup : public testing::Test {
  protected:
    /// Checks that scipd exits with 2, or that code, says why only on standard error, and leaves
    /// nothing behind. Returns the message.
    std::string refusal(const Arguments& arguments, int exit_code = 2) {
        DaemonProcess daemon(directory_, arguments);
        EXPECT_EQ(daemon.wait(), exit_code);
        EXPECT_EQ(daemon.standard_output(), "");
        EXPECT_THAT(daemon.standard_error(), EndsWith("\n"));
        return daemon.standard_error();
    }

    /// What scipctl says of the sensors of the scipd that it finds by itself.
    [[nodiscard]] Outcome scipctl() const {
        return run({"/usr/bin/env", "XDG_RUNTIME_DIR=" + directory_.path().string(), SCIPCTL,
                    "sensors", "--json"});
    }

    [[nodiscard]] fs::path run_directory() const { return directory_.path() / "scipd"; }

    TempDir directory_;
};

TEST_F(Startup, TellsEveryFaultOfABrokenConfiguration) {
    const fs::path file = directory_.write("bad.yaml", R"(scene: nowhere.sdf
robots:
  rescue:
    speed: 3
    sensors:
      front: {model: UST-99LX, tcp: 127.0.0.1:99999}
)");
    const std::string faults = refusal({"--config", file});
    const std::string name = file.string();
    EXPECT_THAT(faults, StartsWith(name + ":1: scene: "));
    EXPECT_THAT(faults, HasSubstr("\n" + name + ":4: robots.rescue.speed: "));
    EXPECT_THAT(faults, HasSubstr("\n" + name + ":6: robots.rescue.sensors.front.model: "));
    EXPECT_THAT(faults, HasSubstr("\n" + name + ":6: robots.rescue.sensors.front.tcp: "));
    EXPECT_FALSE(fs::exists(run_directory()));
}

TEST_F(Startup, TellsEveryFaultOfABrokenWorld) {
    const fs::path world = directory_.write("bad.sdf", R"(<sdf version="1.9"><world name="bad">
<model name="a"><link name="l"><visual name="v">
<geometry><mesh><uri>gone.obj</uri></mesh></geometry></visual></link></model>
<model name="b"><link name="l"><visual name="v">
<geometry><mesh><uri>lost.stl</uri></mesh></geometry></visual></link></model>
</world></sdf>)");
    const std::string faults = refusal({"--scene", world, "--tcp", "127.0.0.1:0", "--pty", "auto"});
    EXPECT_THAT(faults, HasSubstr(world.string() + ":"));
    EXPECT_THAT(faults, HasSubstr("gone.obj"));
    EXPECT_THAT(faults, HasSubstr("lost.stl"));
    EXPECT_FALSE(fs::exists(run_directory() / "robot-scanner"));
    EXPECT_FALSE(fs::exists(run_directory() / "control.sock"));
}

TEST_F(Startup, SaysWhichPortIsInUse) {
    const TempDir elsewhere;
    DaemonProcess first(elsewhere, on_tcp());
    const std::string address = "127.0.0.1:" + std::to_string(first.port());
    const fs::path file =
        directory_.write("ports.yaml", "scene: " + scene("square_room.sdf").string() + R"(
robots:
  rescue:
    sensors:
      front: {model: UST-10LX, pty: auto}
      rear: {model: UST-10LX, tcp: ")" + address +
                                           "\"}\n");
    EXPECT_THAT(refusal({"--config", file}),
                HasSubstr("cannot listen on " + address + ": Address already in use"));
    // What it had opened before the fault is gone.
    EXPECT_FALSE(fs::is_symlink(run_directory() / "rescue-front"));
    EXPECT_FALSE(fs::exists(run_directory() / "control.sock"));
    EXPECT_EQ(ScannerWire::tcp(first.port()).ask("VV"), "00");
}

// The address is of 192.0.2.0/24, which no machine has (RFC 5737).
TEST_F(Startup, MayDoBetterLaterWhereItLacksAnAddress) {
    const std::string lacks = ": this machine has no such address now; ";
    EXPECT_THAT(refusal(in_square_room({"--tcp", "192.0.2.1:10940", "--pty", "none"}), 1),
                HasSubstr("cannot listen on 192.0.2.1:10940" + lacks));
    directory_.write("token", "a-token-of-this-test-0123456789\n");
    fs::permissions(directory_.path() / "token", fs::perms::owner_read);
    const fs::path on_http =
        directory_.write("http.yaml", "scene: " + scene("square_room.sdf").string() + R"(
http: {listen: "192.0.2.1:8080", token_file: token}
robots: {rescue: {sensors: {front: {model: UST-10LX, pty: auto}}}}
)");
    EXPECT_THAT(refusal({"--config", on_http}, 1),
                HasSubstr("cannot listen on 192.0.2.1:8080" + lacks));
    const fs::path file =
        directory_.write("poses.yaml", "scene: " + scene("square_room.sdf").string() + R"(
robots:
  rescue: {poses: "udp:192.0.2.1:14550", sensors: {front: {model: UST-10LX, pty: auto}}}
)");
    EXPECT_THAT(refusal({"--config", file}, 1),
                HasSubstr("cannot receive poses on 192.0.2.1:14550" + lacks));
}

// Drivers are pointed at that port: they would speak to the wrong scanner if it were another one.
TEST_F(Startup, RefusesAPortOfAnotherScipdAndSaysWhatToDo) {
    DaemonProcess first(directory_, on_tcp());
    const std::string address = "127.0.0.1:" + std::to_string(first.port());
    const std::string why = refusal(in_square_room({"--tcp", address, "--pty", "none"}));
    EXPECT_THAT(why, HasSubstr("cannot listen on " + address +
                               ": Address already in use, maybe by "
                               "another scipd; "));
    EXPECT_THAT(why, HasSubstr("--tcp 127.0.0.1:0"));
    EXPECT_EQ(ScannerWire::tcp(first.port()).ask("VV"), "00");
    EXPECT_EQ(first.get("/status").at("sensors").size(), 1U);
}

TEST_F(Startup, SaysWhatToNameWhereSeveralRunAndNoneIsTheUsualOne) {
    std::optional<DaemonProcess> first(std::in_place, directory_, on_tty());
    DaemonProcess second(directory_, on_tty());
    DaemonProcess third(directory_, on_tty());
    first->signal(SIGKILL);  // its socket stays, and nobody listens there
    EXPECT_EQ(first->wait(), 128 + SIGKILL);
    const Outcome outcome = scipctl();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("several scipd run; name the socket of one with --control"));
    EXPECT_THAT(outcome.err, HasSubstr(second.control().string()));
    EXPECT_THAT(outcome.err, HasSubstr(third.control().string()));
}

TEST_F(Startup, LeavesAnotherScipdAlone) {
    DaemonProcess first(directory_, on_tty());
    const std::string used =
        " is used by another scipd, process " + std::to_string(first.pid()) + "; end that one";
    EXPECT_THAT(refusal(in_square_room({"--tcp", "none", "--pty", first.tty()})),
                HasSubstr(first.tty().string() + used));
    EXPECT_THAT(refusal(in_square_room({"--tcp", "none", "--control", first.control()})),
                HasSubstr(first.control().string() + used));
    EXPECT_EQ(ScannerWire::tty(first.tty()).ask("VV"), "00");
    EXPECT_EQ(first.get("/status").at("sensors").size(), 1U);
}

TEST_F(Startup, FindsASocketOfItsOwnWhereTheLockOfTheFirstIsGone) {
    DaemonProcess first(directory_, on_tty());
    fs::remove(run_directory() / ".control.sock.lock");
    DaemonProcess second(directory_, on_tty());
    ASSERT_NE(second.ready_line(), "") << second.standard_error();
    EXPECT_EQ(second.control(),
              run_directory() / ("control-" + std::to_string(second.pid()) + ".sock"));
    EXPECT_EQ(first.get("/sensors").size(), 1U);
}

TEST_F(Startup, RemovesWhatAKilledOneHasLeftUnderNamesOfItsOwn) {
    DaemonProcess first(directory_, on_tty());
    DaemonProcess second(directory_, on_tty());
    DaemonProcess third(directory_, on_tty());
    ASSERT_NE(third.ready_line(), "") << third.standard_error();
    const fs::path precious = directory_.write("scipd/notes-999999999", "mine");
    directory_.write("scipd/.notes-999999999.lock", "");
    second.signal(SIGKILL);
    second.wait();
    EXPECT_TRUE(fs::exists(second.control()));
    DaemonProcess fourth(directory_, on_tty());
    ASSERT_NE(fourth.ready_line(), "") << fourth.standard_error();
    const auto left = [&](const DaemonProcess& daemon) {
        const std::string process = std::to_string(daemon.pid());
        return std::count_if(fs::directory_iterator(run_directory()), fs::directory_iterator(),
                             [&](const fs::directory_entry& entry) {
                                 const std::string name = entry.path().filename();
                                 return name.find(process) != name.npos;
                             });
    };
    EXPECT_EQ(left(second), 0);
    EXPECT_EQ(left(third), 4) << "which lives: a socket, a tty and their locks";
    EXPECT_TRUE(fs::exists(precious));
    EXPECT_EQ(ScannerWire::tty(third.tty()).ask("VV"), "00");
}

TEST_F(Startup, GivesItsProcessToTheNamesThatTheFirstScipdHas) {
    DaemonProcess first(directory_, on_tty());
    DaemonProcess second(directory_, on_tty());
    ASSERT_NE(second.ready_line(), "") << second.standard_error();
    const std::string process = std::to_string(second.pid());
    EXPECT_EQ(first.tty(), run_directory() / "robot-scanner");
    EXPECT_EQ(first.control(), run_directory() / "control.sock");
    EXPECT_EQ(second.tty(), run_directory() / ("robot-scanner-" + process));
    EXPECT_EQ(second.control(), run_directory() / ("control-" + process + ".sock"));
    for (const DaemonProcess* daemon : {&first, &second}) {
        EXPECT_EQ(ScannerWire::tty(daemon->tty()).ask("VV"), "00");
        EXPECT_EQ(daemon->get("/sensors")[0].at("pty"), daemon->tty().string());
    }
    const Outcome of_several = scipctl();
    EXPECT_THAT(of_several.out, HasSubstr(first.tty().string()));
    EXPECT_EQ(of_several.err, "several scipd run; this is the one at " + first.control().string() +
                                  ". --control names another: " + second.control().string() + "\n");
    // The end of one does not affect the other.
    first.signal(SIGTERM);
    EXPECT_EQ(first.wait(), 0);
    const Outcome of_the_second = scipctl();
    EXPECT_THAT(of_the_second.out, HasSubstr(second.tty().string()));
    EXPECT_EQ(of_the_second.err, "");
    EXPECT_EQ(ScannerWire::tty(second.tty()).ask("VV"), "00");
    EXPECT_EQ(second.get("/sensors").size(), 1U);
    DaemonProcess third(directory_, on_tty());
    EXPECT_EQ(third.tty(), first.tty());
    EXPECT_EQ(third.control(), first.control());
    second.signal(SIGTERM);
    EXPECT_EQ(second.wait(), 0);
    EXPECT_FALSE(fs::exists(second.control()));
    EXPECT_EQ(ScannerWire::tty(third.tty()).ask("VV"), "00");
}

// Otherwise the first scipd, when it ends, would remove what the second one puts there.
TEST_F(Startup, LeavesNamesToAnotherScipdWhoseFilesAreGone) {
    DaemonProcess first(directory_, on_tty());
    fs::remove(first.tty());
    fs::remove(first.control());
    DaemonProcess second(directory_, on_tty());
    first.signal(SIGTERM);
    EXPECT_EQ(first.wait(), 0);
    EXPECT_EQ(ScannerWire::tty(second.tty()).ask("VV"), "00");
    EXPECT_EQ(second.get("/sensors").size(), 1U);
}

TEST_F(Startup, ReplacesWhatAKilledOneLeftBehind) {
    {
        DaemonProcess killed(directory_, on_tty());
        killed.signal(SIGKILL);
        EXPECT_EQ(killed.wait(), 128 + SIGKILL);
    }
    const fs::path link = run_directory() / "robot-scanner";
    ASSERT_TRUE(fs::is_symlink(link));
    DaemonProcess next(directory_, on_tty());
    ASSERT_NE(next.ready_line(), "") << next.standard_error();
    EXPECT_EQ(next.tty(), link);
    EXPECT_EQ(next.control(), run_directory() / "control.sock");
    EXPECT_EQ(ScannerWire::tty(next.tty()).ask("VV"), "00");
}

TEST_F(Startup, OpensWhatIsClosedOfStandardInputAndOutput) {
    DaemonProcess daemon(directory_, in_square_room({"--poses", "-", "--tcp", "127.0.0.1:0"}),
                         {.closed = {STDIN_FILENO, STDERR_FILENO}});
    ASSERT_NE(daemon.ready_line(), "");
    const fs::path open = "/proc/" + std::to_string(daemon.pid()) + "/fd";
    EXPECT_EQ(fs::read_symlink(open / "0"), "/dev/null");
    EXPECT_EQ(fs::read_symlink(open / "2"), "/dev/null");
    // No descriptor is mixed up: the reader of the poses does not take the loader's message that it
    // is done.
    const nlohmann::json world{{"file", scene("corridor.sdf").string()}};
    EXPECT_EQ(control_request(daemon.control(), "PUT", "/scene", world.dump()).status, 200);
}

TEST_F(Startup, RunsAlsoWhereNobodyHearsThatItIsReady) {
    DaemonProcess daemon(directory_, on_tty(), {.closed = {STDOUT_FILENO}});
    const fs::path control = run_directory() / "control.sock";
    EXPECT_TRUE(eventually([&] { return fs::exists(control); }));
    EXPECT_TRUE(eventually([&] { return fs::is_symlink(run_directory() / "robot-scanner"); }));
    EXPECT_EQ(control_get(control, "/status").at("sensors").size(), 1U);
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
}

// Scripts depend on the exit code.
TEST_F(Startup, ProbesWhetherAnythingCanBeDrawn) {
    DaemonProcess here(directory_, {"--probe"});
    EXPECT_EQ(here.wait(), can_draw() ? 0 : 1);
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
    DaemonProcess without_a_driver(directory_, {"--probe"});
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    EXPECT_EQ(without_a_driver.wait(), 1);
    EXPECT_THAT(without_a_driver.standard_output(), HasSubstr("libgl1-mesa-dri"));
    EXPECT_EQ(without_a_driver.standard_error(), "");
}

TEST_F(Startup, SaysWhereItListensAndNothingElse) {
    DaemonProcess daemon(directory_, in_square_room({"--tcp", "127.0.0.1:0", "--name", "r2/top"}));
    const std::string port = std::to_string(daemon.port());
    const std::string run = run_directory().string();
    EXPECT_EQ(daemon.ready_line(),
              R"({"ready":true,"sensors":[{"name":"r2/top","model":"UST-10LX","tcp":"127.0.0.1:)" +
                  port + R"(","pty":")" + run + R"(/r2-top"}],"control":")" + run +
                  R"(/control.sock","http":null})");
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    (void)wire.next_scan();
    daemon.signal(SIGHUP);  // warns, as there is no configuration to read again
    EXPECT_TRUE(
        eventually([&] { return daemon.standard_error().find("SIGHUP") != std::string::npos; }));
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
    EXPECT_EQ(daemon.standard_output(), daemon.ready_line() + "\n");
}

TEST_F(Startup, SaysWherePosesMayBeSent) {
    DaemonProcess daemon(directory_, on_tcp({"--poses", "udp:127.0.0.1:0", "--name", "r2/top"}));
    const auto poses = nlohmann::json::parse(daemon.ready_line()).at("poses");
    ASSERT_EQ(poses.size(), 1U);
    const std::string source = poses.at("r2");
    EXPECT_THAT(source, StartsWith("udp:127.0.0.1:"));
    const UdpSender sender(
        static_cast<std::uint16_t>(std::stoul(source.substr(source.rfind(':') + 1))));
    sender.send(R"({"xyz":[1,0,0]})");
    EXPECT_TRUE(eventually([&] { return daemon.get("/status").at("poses").at("accepted") == 1; }));
}

class Ending : public testing::TestWithParam<int> {};

TEST_P(Ending, LeavesNothingBehind) {
    const TempDir directory;
    DaemonProcess daemon(directory, in_square_room({"--tcp", "127.0.0.1:0"}));
    ASSERT_TRUE(fs::is_symlink(daemon.tty()));
    ASSERT_TRUE(fs::is_socket(daemon.control()));
    ScannerWire tcp = ScannerWire::tcp(daemon.port());
    ScannerWire tty = ScannerWire::tty(daemon.tty());
    EXPECT_EQ(tcp.ask(stream_of_all_beams), "00");
    EXPECT_EQ(tty.ask(stream_of_all_beams), "00");

    daemon.signal(GetParam());
    EXPECT_EQ(daemon.wait(), 0);
    EXPECT_FALSE(fs::is_symlink(daemon.tty()));
    EXPECT_FALSE(fs::exists(daemon.control()));
    EXPECT_TRUE(tcp.ends());
}

INSTANTIATE_TEST_SUITE_P(Signals, Ending, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace scipd::tests
