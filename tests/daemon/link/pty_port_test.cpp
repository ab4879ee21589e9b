// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/pty_port.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::ScannerWire;
namespace fs = std::filesystem;

/// A tty as another program opens it.
class Terminal {
  public:
    Terminal() {
        std::array<char, 64> name{};
        EXPECT_EQ(::openpty(&master_, &slave_, name.data(), nullptr, nullptr), 0);
        path_ = name.data();
    }
    ~Terminal() {
        ::close(master_);
        ::close(slave_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    int master_ = -1;
    int slave_ = -1;
    fs::path path_;
};

class CountingWatch : public ClientWatch {
  public:
    void came(const std::string&) override { ++came_; }
    void waits(const std::string&, const std::string&) override {}
    void left(protocol::LinkKind, Leaving why) override { left_.push_back(why); }

    int came_ = 0;
    std::vector<Leaving> left_;
};

class PtyPortTest : public testing::Test {
  protected:
    [[nodiscard]] std::shared_ptr<PtyPort> make(const fs::path& link) {
        return std::make_shared<PtyPort>(io_.get_executor(), link);
    }

    /// Why it cannot be made.
    std::string refusal(const fs::path& link) {
        try {
            (void)make(link);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "none";
    }

    bool comes(ScannerWire& wire, const std::string& text) {
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received == text;
        });
    }

    void let_things_end() {
        io_.restart();
        io_.run_for(10ms);
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    tests::TempDir directory_;
    fs::path link_ = directory_.path() / "new" / "folder" / "tty";
};

TEST_F(PtyPortTest, MakesItsLinkAndTakesItAway) {
    const auto port = make(link_);
    EXPECT_EQ(port->address(), link_);
    EXPECT_EQ(fs::read_symlink(link_).parent_path(), "/dev/pts");
    EXPECT_TRUE(fs::is_character_file(link_));
    port->serve(device_);
    port->stop();
    EXPECT_FALSE(fs::is_symlink(link_));
    let_things_end();
}

TEST_F(PtyPortTest, LetsItsGroupInAndNobodyElse) {
    const auto port = make(link_);
    struct stat tty = {};
    ASSERT_EQ(::stat(link_.c_str(), &tty), 0);
    EXPECT_EQ(tty.st_mode & ALLPERMS, 0660U);
    EXPECT_EQ(tty.st_gid, ::getegid());
}

TEST_F(PtyPortTest, TakesItsLinkAwayEvenIfItNeverServed) {
    make(link_).reset();
    EXPECT_FALSE(fs::is_symlink(link_));
}

TEST_F(PtyPortTest, ReplacesTheLinkOfOneThatWasKilled) {
    const fs::path stale = directory_.path() / "stale";
    fs::create_symlink("/dev/pts/4000000", stale);
    const auto port = make(stale);
    EXPECT_TRUE(fs::is_character_file(stale));
}

// As xterm does where it gets the number of a scipd that was killed.
TEST_F(PtyPortTest, ReplacesALinkThatIsOlderThanTheTerminalItLeadsTo) {
    const Terminal terminal;
    const fs::path stale = directory_.path() / "stale";
    fs::create_symlink(terminal.path(), stale);
    const std::array<timespec, 2> long_ago{};
    ASSERT_EQ(::utimensat(AT_FDCWD, stale.c_str(), long_ago.data(), AT_SYMLINK_NOFOLLOW), 0);
    const auto port = make(stale);
    EXPECT_NE(fs::read_symlink(stale), terminal.path());
    EXPECT_TRUE(fs::is_character_file(stale));
}

TEST_F(PtyPortTest, ReplacesNothingElse) {
    const fs::path file = directory_.write("file", "precious");
    EXPECT_THAT(refusal(file),
                HasSubstr("is there and is no link; remove it, or choose another name"));
    EXPECT_EQ(fs::file_size(file), 8U);

    const fs::path elsewhere = directory_.path() / "elsewhere";
    fs::create_symlink(file, elsewhere);
    EXPECT_THAT(refusal(elsewhere),
                HasSubstr("leads to " + file.string() + ", which is no tty of scipd's; remove it"));
    EXPECT_EQ(fs::read_symlink(elsewhere), file);

    // As socat makes one: link=elsewhere.
    const Terminal terminal;
    const fs::path living = directory_.path() / "living";
    fs::create_symlink(terminal.path(), living);
    EXPECT_THAT(refusal(living), HasSubstr("leads to " + terminal.path().string() +
                                           ", a tty of another program; end that one, or choose"));
    EXPECT_EQ(fs::read_symlink(living), terminal.path());
}

TEST_F(PtyPortTest, LeavesTheLinkOfAnotherAlone) {
    auto first = make(link_);
    const fs::path target = fs::read_symlink(link_);
    // Whatever it is called, and even where the link has been taken away meanwhile.
    const fs::path nickname = directory_.path() / "nickname";
    fs::create_directory_symlink(link_.parent_path(), nickname);
    EXPECT_THROW((void)make(link_), PathHeld);
    EXPECT_THROW((void)make(nickname / link_.filename()), PathHeld);
    EXPECT_EQ(fs::read_symlink(link_), target);
    fs::remove(link_);
    EXPECT_THROW((void)make(link_), PathHeld);

    first->stop();
    const auto second = make(link_);
    first.reset();
    EXPECT_TRUE(fs::is_character_file(link_));
}

// Drivers for serial lines set its rate first.
TEST_F(PtyPortTest, HasNoRateToSetOnAModelForEthernet) {
    const auto port = make(link_);
    port->serve(device_);
    ScannerWire wire = ScannerWire::tty(link_);
    wire.write("SS115200\n");
    EXPECT_TRUE(comes(wire, "SS115200\n04T\n\n"));
    port->stop();
    let_things_end();
}

TEST_F(PtyPortTest, KnowsWhetherSomebodyHasItOpen) {
    const auto port = make(link_);
    port->serve(device_);
    EXPECT_FALSE(port->connected());
    {
        ScannerWire first = ScannerWire::tty(link_);
        ScannerWire second = ScannerWire::tty(link_);
        EXPECT_TRUE(run_until(io_, [&] { return port->connected(); }));
        first.close();
        second.write("QT\n");
        EXPECT_TRUE(comes(second, "QT\n00P\n\n"));
        EXPECT_TRUE(port->connected());
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port->connected(); }));
    port->stop();
    let_things_end();
}

// What the README tells of pseudo-terminals, which a kernel may have otherwise some day.
TEST_F(PtyPortTest, HasNoModemLinesAndLosesWhatIsFlushed) {
    const auto port = make(link_);
    port->serve(device_);
    ScannerWire wire = ScannerWire::tty(link_);
    int modem_lines = 0;
    EXPECT_EQ(::ioctl(wire.descriptor(), TIOCMGET, &modem_lines), -1);
    EXPECT_EQ(errno, ENOTTY);

    const std::string reply = "QT\n00P\n\n";
    wire.write("QT\n");
    EXPECT_TRUE(run_until(io_, [&] {
        int there = 0;
        return ::ioctl(wire.descriptor(), FIONREAD, &there) == 0 &&
               there >= static_cast<int>(reply.size());
    }));
    EXPECT_EQ(::tcflush(wire.descriptor(), TCIFLUSH), 0);
    wire.write("QT\n");
    EXPECT_TRUE(comes(wire, reply));  // one, not two
    port->stop();
    let_things_end();
}

/// How many events the kernel keeps for one who does not read them.
int most_events() {
    int most = 0;
    std::ifstream("/proc/sys/fs/inotify/max_queued_events") >> most;
    return most;
}

// While the thread is busy, others open terminals so often that the kernel drops some of it.
TEST_F(PtyPortTest, FindsOutWhoHasItOpenWhereTheKernelHasDroppedWhatItWasToTell) {
    if (most_events() > 1'000'000) GTEST_SKIP() << "too many events for a test";
    const auto port = make(link_);
    port->serve(device_);
    const auto overflow = [&] {
        // Each tells of an open and a close, by the tty and by its folder.
        for (int i = 0; i < most_events() / 4 + 10; ++i)
            ScannerWire::tty(link_).close();
    };
    const auto is_answered = [&](ScannerWire& wire) {
        wire.write("QT\n");
        return comes(wire, "QT\n00P\n\n");
    };
    overflow();
    {
        ScannerWire first = ScannerWire::tty(link_);
        ASSERT_TRUE(run_until(io_, [&] { return port->connected(); }));
        EXPECT_TRUE(is_answered(first));
        overflow();
        ScannerWire second = ScannerWire::tty(link_);
        EXPECT_TRUE(is_answered(first));
        first.close();
        EXPECT_TRUE(is_answered(second));
        EXPECT_TRUE(port->connected());
        second.write("BM\nMD0540054000000\n");
        EXPECT_TRUE(run_until(io_, [&] { return device_.wanted(); }));
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port->connected() && !device_.wanted(); }));
    // The count is right again, and so are the settings.
    ScannerWire third = ScannerWire::tty(link_);
    termios settings{};
    EXPECT_EQ(::tcgetattr(third.descriptor(), &settings), 0);
    EXPECT_EQ(settings.c_lflag & (ICANON | ECHO), 0U);
    EXPECT_TRUE(is_answered(third));
    third.close();
    EXPECT_TRUE(run_until(io_, [&] { return !port->connected(); }));
    port->stop();
    let_things_end();
}

// Nobody else may open it then, and scipd has no more rights.
TEST_F(PtyPortTest, LeavesATtyToADriverThatHasItForItselfWhereEventsWereDropped) {
    if (most_events() > 1'000'000) GTEST_SKIP() << "too many events for a test";
    const auto port = make(link_);
    port->serve(device_);
    ScannerWire wire = ScannerWire::tty(link_);
    for (int i = 0; i < most_events() / 4 + 10; ++i)
        ScannerWire::tty(link_).close();
    ASSERT_EQ(::ioctl(wire.descriptor(), TIOCEXCL), 0);
    wire.write("QT\n");
    EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
    int exclusive = 0;
    EXPECT_EQ(::ioctl(wire.descriptor(), TIOCGEXCL, &exclusive), 0);
    EXPECT_EQ(exclusive, 1);
    port->stop();
    let_things_end();
}

TEST_F(PtyPortTest, HangsUpWhereAnotherScannerComesBehindIt) {
    Device other{"robot", ideal_sensor("UTM-30LX"), 1, world_, clock_};
    CountingWatch watch;
    const auto port = make(link_);
    port->set_watch(&watch);
    port->serve(device_);
    const fs::path terminal = fs::read_symlink(link_);
    ScannerWire old = ScannerWire::tty(link_);
    old.write("QT\n");
    EXPECT_TRUE(comes(old, "QT\n00P\n\n"));
    port->prepare();
    EXPECT_EQ(fs::read_symlink(link_), terminal);
    EXPECT_TRUE(port->connected());

    port->serve(other);
    EXPECT_FALSE(port->connected());
    EXPECT_TRUE(old.ends());
    EXPECT_NE(fs::read_symlink(link_), terminal);
    EXPECT_EQ(watch.left_, std::vector{Leaving::ended});
    ScannerWire next = ScannerWire::tty(link_);
    next.write("QT\n");
    EXPECT_TRUE(comes(next, "QT\n00P\n\n"));
    EXPECT_EQ(other.clients(), 1U);
    EXPECT_EQ(device_.clients(), 0U);
    old.close();
    next.close();
    EXPECT_TRUE(run_until(io_, [&] { return !port->connected(); }));
    EXPECT_EQ(watch.came_, 2);
    EXPECT_EQ(watch.left_, (std::vector{Leaving::ended, Leaving::closed}));
    port->stop();
    EXPECT_FALSE(fs::is_symlink(link_));
    let_things_end();
}

TEST_F(PtyPortTest, DropsWhatIsSentWhileNobodyHasItOpen) {
    const auto port = make(link_);
    port->serve(device_, {.stop_on_close = false});
    std::int64_t revolution = 0;
    {
        ScannerWire wire = ScannerWire::tty(link_);
        wire.write("MD0000108000000\n");
        EXPECT_TRUE(comes(wire, "MD0000108000000\n00P\n\n"));
        revolution = device_.next_revolution();
        // Two scans into the tty, which nobody reads.
        for (int i = 0; i < 5; ++i) {
            device_.turn_complete(revolution++);
            io_.restart();
            io_.poll();
        }
    }
    ASSERT_TRUE(run_until(io_, [&] { return !port->connected(); }));
    const std::uint64_t before = device_.counts().scans;
    device_.turn_complete(revolution++);
    // The stream belongs to the session, which goes on.
    EXPECT_EQ(device_.counts().scans, before + 1);
    let_things_end();

    ScannerWire wire = ScannerWire::tty(link_);
    wire.write("QT\n");
    EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
    port->stop();
    let_things_end();
}

}  // namespace
}  // namespace scipd::daemon
