// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/pty_port.h"

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "daemon/device/wall_clock.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::ScannerWire;
namespace fs = std::filesystem;

class PtyPortTest : public testing::Test {
  protected:
    [[nodiscard]] std::shared_ptr<PtyPort> make(const fs::path& link) {
        return std::make_shared<PtyPort>(io_.get_executor(), link);
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
    EXPECT_EQ(port->link(), link_);
    EXPECT_EQ(fs::read_symlink(link_).parent_path(), "/dev/pts");
    EXPECT_TRUE(fs::is_character_file(link_));
    port->serve(device_);
    port->stop();
    EXPECT_FALSE(fs::is_symlink(link_));
    let_things_end();
}

TEST_F(PtyPortTest, TakesItsLinkAwayEvenIfItNeverServed) {
    make(link_).reset();
    EXPECT_FALSE(fs::is_symlink(link_));
}

TEST_F(PtyPortTest, ReplacesALinkAndNothingElse) {
    const fs::path stale = directory_.path() / "stale";
    fs::create_symlink("/dev/pts/nowhere", stale);
    const auto port = make(stale);
    EXPECT_TRUE(fs::is_character_file(stale));

    const fs::path file = directory_.write("file", "precious");
    EXPECT_THROW((void)make(file), std::runtime_error);
    EXPECT_EQ(fs::file_size(file), 8U);
    EXPECT_FALSE(fs::is_symlink(file.string() + ".new"));
}

TEST_F(PtyPortTest, LeavesTheLinkOfAnotherAlone) {
    auto first = make(link_);
    const auto second = make(link_);
    const fs::path target = fs::read_symlink(link_);
    first.reset();
    EXPECT_EQ(fs::read_symlink(link_), target);
}

TEST_F(PtyPortTest, KnowsWhetherSomebodyHasItOpen) {
    const auto port = make(link_);
    port->serve(device_);
    EXPECT_FALSE(port->open());
    {
        ScannerWire first = ScannerWire::tty(link_);
        ScannerWire second = ScannerWire::tty(link_);
        EXPECT_TRUE(run_until(io_, [&] { return port->open(); }));
        first.close();
        second.write("QT\n");
        EXPECT_TRUE(comes(second, "QT\n00P\n\n"));
        EXPECT_TRUE(port->open());
    }
    EXPECT_TRUE(run_until(io_, [&] { return !port->open(); }));
    port->stop();
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
    ASSERT_TRUE(run_until(io_, [&] { return !port->open(); }));
    const std::uint64_t before = device_.scans_sent();
    device_.turn_complete(revolution++);
    // The stream belongs to the session, which goes on.
    EXPECT_EQ(device_.scans_sent(), before + 1);
    let_things_end();

    ScannerWire wire = ScannerWire::tty(link_);
    wire.write("QT\n");
    EXPECT_TRUE(comes(wire, "QT\n00P\n\n"));
    port->stop();
    let_things_end();
}

}  // namespace
}  // namespace scipd::daemon
