// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tcp_port.h"

#include <array>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::local_address;
using tests::ScannerWire;

std::ptrdiff_t open_descriptors() {
    return std::ranges::distance(std::filesystem::directory_iterator("/proc/self/fd"));
}

class TcpPortTest : public testing::Test {
  protected:
    ~TcpPortTest() override {
        if (port_) port_->stop();
        io_.restart();
        io_.run_for(10ms);
    }

    [[nodiscard]] ScannerWire connect() const {
        return ScannerWire::tcp(tests::port_of(port_->address()));
    }

    /// Those who have connected stand in line then.
    void let_them_come() {
        io_.restart();
        io_.run_for(50ms);
    }

    /// These become its port's limits.
    std::shared_ptr<Limits> hold_to(Limit limit, int value) {
        LimitValues values;
        values[limit] = value;
        auto limits = std::make_shared<Limits>(values);
        port_->hold_to(limits);
        return limits;
    }

    /// Whether the answer to VV comes from this model: the end of its PROD.
    bool is_answered_by(ScannerWire& wire, const std::string& model) {
        wire.write("VV\n");
        return comes(wire, model + ";");
    }

    bool comes(ScannerWire& wire, const std::string& text) {
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received.find(text) != std::string::npos;
        });
    }

    bool is_cut_off(ScannerWire& wire) {
        return run_until(io_, [&] {
            try {
                std::array<char, 1024> buffer;
                (void)wire.read(buffer, 0ms);
                return false;
            } catch (const std::runtime_error&) {
                return true;
            }
        });
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    Device other_{"robot", ideal_sensor("UTM-30LX"), 1, world_, clock_};
    std::shared_ptr<TcpPort> port_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
};

TEST_F(TcpPortTest, TellsThePortThatItTook) {
    EXPECT_EQ(port_->address().rfind("127.0.0.1:", 0), 0U);
    EXPECT_NE(port_->address(), "127.0.0.1:0");
    const TcpPort six(io_.get_executor(), Address{"::1", 0});
    EXPECT_EQ(six.address().rfind("[::1]:", 0), 0U);
}

TEST_F(TcpPortTest, RefusesAPortThatIsTaken) {
    const std::string taken = port_->address();
    const auto number = static_cast<std::uint16_t>(std::stoul(taken.substr(taken.rfind(':') + 1)));
    try {
        const TcpPort second(io_.get_executor(), Address{"127.0.0.1", number});
        FAIL() << "it was taken twice";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("cannot listen on " + taken + ": ", 0), 0U)
            << error.what();
    }
}

TEST_F(TcpPortTest, ServesOneClientAtATime) {
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    EXPECT_TRUE(port_->connected());
    ScannerWire second = connect();
    second.write("VV\n");
    io_.restart();
    io_.run_for(100ms);
    EXPECT_EQ(device_.clients(), 1U);

    first.close();
    EXPECT_TRUE(comes(second, "PROD:UST-10LX;"));
    EXPECT_EQ(device_.clients(), 1U);
}

TEST_F(TcpPortTest, NamesWhoIsConnectedAndWhoWaits) {
    port_->serve(device_);
    EXPECT_EQ(port_->client(), "");
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire second = connect();
    ScannerWire third = connect();
    let_them_come();
    EXPECT_EQ(port_->client(), local_address(first));
    EXPECT_EQ(port_->waiting(), (std::vector{local_address(second), local_address(third)}));
    const std::string last = local_address(third);
    second.close();
    EXPECT_TRUE(run_until(io_, [&] { return port_->waiting() == std::vector{last}; }));
    first.close();
    EXPECT_TRUE(run_until(io_, [&] { return port_->client() == last; }));
    EXPECT_TRUE(port_->waiting().empty());
}

TEST_F(TcpPortTest, LetsAFewWaitInTurnAndClosesTheOthersAtOnce) {
    const auto limits = hold_to(Limit::scanner_connections, 3);
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire second = connect();
    ScannerWire third = connect();
    second.write("VV\n");
    third.write("VV\n");
    let_them_come();
    EXPECT_EQ(limits->refused(Limit::scanner_connections), 0U);
    ScannerWire fourth = connect();
    EXPECT_TRUE(is_cut_off(fourth));
    EXPECT_EQ(limits->refused(Limit::scanner_connections), 1U);
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));

    first.close();
    EXPECT_TRUE(comes(second, "PROD:UST-10LX;"));
    ScannerWire fifth = connect();  // there is room again
    fifth.write("VV\n");
    second.close();
    EXPECT_TRUE(comes(third, "PROD:UST-10LX;"));
    third.close();
    EXPECT_TRUE(comes(fifth, "PROD:UST-10LX;"));
    EXPECT_EQ(limits->refused(Limit::scanner_connections), 1U);
}

// As a driver does that tries again and again while another one is served.
TEST_F(TcpPortTest, GivesThePlacesOfThoseWhoHungUpWhileTheyWaitedToOthers) {
    const auto limits = hold_to(Limit::scanner_connections, 5);
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire waits = connect();
    waits.write("VV\n");
    ScannerWire closed = connect();
    ScannerWire closed_with_bytes = connect();
    closed_with_bytes.write("VV\n");
    ScannerWire reset = connect();
    let_them_come();
    closed.close();
    closed_with_bytes.close();
    reset.abort();
    ScannerWire next = connect();
    next.write("VV\n");
    let_them_come();
    EXPECT_EQ(limits->refused(Limit::scanner_connections), 0U);
    EXPECT_EQ(device_.clients(), 1U);
    first.close();
    EXPECT_TRUE(comes(waits, "PROD:UST-10LX;"));
    waits.close();
    EXPECT_TRUE(comes(next, "PROD:UST-10LX;"));
}

TEST_F(TcpPortTest, KeepsNoDescriptorOfThoseWhoSaidNothingAndHungUpOnceTheNextOneComes) {
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    const auto before = open_descriptors();
    std::array gone{connect(), connect(), connect()};
    EXPECT_TRUE(run_until(io_, [&] { return open_descriptors() == before + 6; }));  // two ends each
    gone[0].close();
    gone[1].abort();
    gone[2].close();
    EXPECT_EQ(open_descriptors(), before + 3);
    const ScannerWire next = connect();
    EXPECT_TRUE(run_until(io_, [&] { return open_descriptors() == before + 2; }));
}

TEST_F(TcpPortTest, AnswersAClientThatSentAllWhileItWaitedWhereNobodyNeedsItsPlace) {
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire second = connect();
    second.write("VV\n");
    second.half_close();
    let_them_come();
    ScannerWire third = connect();
    let_them_come();
    first.close();
    EXPECT_TRUE(comes(second, "PROD:UST-10LX;"));
    EXPECT_TRUE(is_cut_off(second));
    EXPECT_TRUE(is_answered_by(third, "UST-10LX"));
}

TEST_F(TcpPortTest, TurnsThoseWhoWaitAwayWhenItRefuses) {
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire second = connect();
    let_them_come();
    port_->set_line({.refuses = true});
    EXPECT_TRUE(is_cut_off(second));
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
}

TEST_F(TcpPortTest, RefusesALineThatIsLongerThanItsLimitAsAWrongOne) {
    const auto limits = hold_to(Limit::scip_line_bytes, 40);
    port_->serve(device_);
    ScannerWire wire = connect();
    const std::string longest = "TM0;" + std::string(36, 'x');
    wire.write(longest + "\n");
    EXPECT_TRUE(comes(wire, longest + "\n"));
    EXPECT_EQ(limits->refused(Limit::scip_line_bytes), 0U);
    wire.write(longest + "y\n");
    EXPECT_TRUE(comes(wire, longest + "\n0D"));
    EXPECT_EQ(limits->refused(Limit::scip_line_bytes), 1U);
}

TEST_F(TcpPortTest, WaitsWithoutHasteForADescriptor) {
    port_->serve(device_);
    ScannerWire wire = connect();
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit none{.rlim_cur = 0, .rlim_max = limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
    io_.restart();
    EXPECT_LT(io_.run_for(300ms), 20U);
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    EXPECT_TRUE(is_answered_by(wire, "UST-10LX"));
}

TEST_F(TcpPortTest, LetsAClientWaitUntilThereIsADevice) {
    ScannerWire early = connect();
    early.write("VV\n");
    io_.run_for(20ms);
    port_->serve(device_);
    EXPECT_TRUE(comes(early, "PROD:UST-10LX;"));
}

TEST_F(TcpPortTest, CutsOffTheClientOfTheDeviceBefore) {
    port_->serve(device_);
    ScannerWire wire = connect();
    EXPECT_TRUE(is_answered_by(wire, "UST-10LX"));
    port_->serve(other_);
    EXPECT_TRUE(is_cut_off(wire));
    ScannerWire next = connect();
    EXPECT_TRUE(is_answered_by(next, "UTM-30LX"));
    EXPECT_EQ(device_.clients(), 0U);
}

TEST_F(TcpPortTest, MovesWithoutLosingWhoeverComesMeanwhile) {
    port_->serve(device_);
    {
        ScannerWire before = connect();
        EXPECT_TRUE(is_answered_by(before, "UST-10LX"));
    }
    ASSERT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
    const std::uint64_t sent_bytes = port_->counts().sent_bytes;
    EXPECT_GT(sent_bytes, 0U);

    ScannerWire cut_off = connect();
    ScannerWire accepted = connect();  // but the port has not been told yet
    ASSERT_TRUE(run_until(io_, [&] { return port_->connected(); }));
    boost::asio::io_context there;
    const std::shared_ptr<TcpPort> old = port_;
    port_ = old->moved_to(there.get_executor());
    ScannerWire in_the_backlog = connect();
    old->stop();
    EXPECT_EQ(port_->address(), old->address());
    EXPECT_EQ(port_->counts().sent_bytes, sent_bytes);
    WallClock clock{there.get_executor()};
    Device device("robot", ideal_sensor(), 1, world_, clock);
    port_->serve(device);
    const auto is_answered = [&](ScannerWire& wire) {
        wire.write("VV\n");
        std::string received;
        return run_until(there, [&] {
            io_.restart();
            io_.poll();
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received.ends_with("\n\n");
        });
    };
    {
        ScannerWire first = std::move(in_the_backlog);
        EXPECT_TRUE(is_answered(first));
    }
    EXPECT_TRUE(is_answered(accepted));
    EXPECT_TRUE(is_cut_off(cut_off));
    port_->stop();
    there.restart();
    there.run_for(10ms);
    port_.reset();  // before the loop that it lives on
}

TEST_F(TcpPortTest, MovesWithThoseWhoWait) {
    port_->serve(device_);
    ScannerWire first = connect();
    EXPECT_TRUE(is_answered_by(first, "UST-10LX"));
    ScannerWire waits = connect();
    let_them_come();
    boost::asio::io_context there;
    const std::shared_ptr<TcpPort> old = port_;
    const auto between = old->moved_to(there.get_executor());
    old->stop();
    // Before it is told who waits, it moves back.
    port_ = between->moved_to(io_.get_executor());
    between->stop();
    there.run_for(20ms);
    port_->serve(other_);
    EXPECT_TRUE(is_answered_by(waits, "UTM-30LX"));
}

TEST_F(TcpPortTest, MovesThereAndBack) {
    boost::asio::io_context there;
    const std::string address = port_->address();
    for (int i = 0; i < 4; ++i) {
        port_->serve(device_);
        const auto moved = port_->moved_to((i % 2 == 0 ? there : io_).get_executor());
        port_->stop();
        port_ = moved;
    }
    EXPECT_EQ(port_->address(), address);
    port_->serve(other_);
    ScannerWire wire = connect();
    EXPECT_TRUE(is_answered_by(wire, "UTM-30LX"));
}

TEST_F(TcpPortTest, TakesTheTimeOfItsLinkAndNoRate) {
    port_->serve(device_, {.latency = 20ms, .baud = 19200});
    ScannerWire wire = connect();
    io_.run_for(20ms);
    const auto asked = std::chrono::steady_clock::now();
    EXPECT_TRUE(is_answered_by(wire, "UST-10LX"));
    EXPECT_GE(std::chrono::steady_clock::now() - asked, 40ms);
}

TEST_F(TcpPortTest, CutsAsItsLinkDoes) {
    port_->serve(device_, {.split_bytes = 7});
    ScannerWire wire = connect();
    wire.write("VV\n");
    std::string received;
    std::size_t reads = 0;
    // Looked at after each step, so that little can run together in the kernel.
    EXPECT_TRUE(run_until(io_, [&] {
        std::array<char, 1024> buffer;
        const std::size_t count = wire.read(buffer, 0ms);
        received.append(buffer.data(), count);
        if (count > 0) ++reads;
        return received.ends_with("\n\n");
    }));
    EXPECT_EQ(received.rfind("VV\n00P\n", 0), 0U);
    EXPECT_GT(reads, received.size() / 7 / 2);
}

TEST_F(TcpPortTest, KeepsAClientThatReadsSlowlyAndNotOneThatNeverDoes) {
    port_->serve(device_, {.dead_after = 3s});
    ScannerWire wire = ScannerWire::tcp(tests::port_of(port_->address()), 4096);
    wire.write("MD0000108000000\n");
    EXPECT_TRUE(comes(wire, "MD0000108000000\n00P\n\n"));
    std::int64_t revolution = device_.next_revolution() + 1;
    const auto fill = [&] {
        const std::uint64_t lost = port_->lost_scans();
        while (port_->lost_scans() == lost) {
            device_.turn_complete(revolution++);
            io_.restart();
            io_.poll();
        }
    };
    for (int round = 0; round < 3; ++round) {
        fill();
        io_.restart();
        io_.run_for(1200ms);
        ASSERT_TRUE(port_->connected()) << round;
        ASSERT_TRUE(run_until(io_, [&] {
            std::array<char, 4096> buffer;
            return wire.read(buffer, 0ms) == 0;
        }));
    }
    fill();
    EXPECT_TRUE(run_until(io_, [&] { return !port_->connected(); }));
}

TEST_F(TcpPortTest, EndsWithItsClient) {
    port_->serve(device_);
    ScannerWire wire = connect();
    EXPECT_TRUE(is_answered_by(wire, "UST-10LX"));
    const std::string address = port_->address();
    port_->stop();
    EXPECT_TRUE(is_cut_off(wire));
    EXPECT_FALSE(port_->connected());
    EXPECT_EQ(device_.clients(), 0U);
}

}  // namespace
}  // namespace scipd::daemon
