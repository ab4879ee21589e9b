// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/driver.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/protocol/shell.h"

namespace scipd::protocol::client {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

/// A scanner of a model, its clock turned by whoever waits for it. Sends in pieces.
class ModelTransport : public Transport {
  public:
    explicit ModelTransport(std::string_view model, std::size_t piece = 4096)
        : shell_(daemon::find_model(model).profile), piece_(piece) {
        shell_.distance = [](int step) { return 1000U + static_cast<std::uint32_t>(step); };
        shell_.intensity = [](int step) { return 2000U + static_cast<std::uint32_t>(step); };
    }

    void write(std::string_view bytes) override { shell_.receive(bytes); }
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override {
        const Uptime end = shell_.now() + timeout;
        while ((unread_ += shell_.take_text()).empty() && shell_.now() < end)
            shell_.advance_to(shell_.now() + 1ms);
        const std::size_t count = std::min({unread_.size(), buffer.size(), piece_});
        std::copy_n(unread_.begin(), count, buffer.begin());
        unread_.erase(0, count);
        return count;
    }
    [[nodiscard]] DeviceState& device() { return shell_.device(); }

  private:
    Shell shell_;
    std::size_t piece_;
    std::string unread_;
};

/// Gives fixed answers to what is written, in order, and keeps it.
class ScriptTransport : public Transport {
  public:
    explicit ScriptTransport(std::deque<std::string> answers) : answers_(std::move(answers)) {}

    void write(std::string_view bytes) override {
        written += bytes;
        if (bytes == "\n" || answers_.empty()) return;
        unread_ += answers_.front();
        answers_.pop_front();
    }
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds) override {
        const std::size_t count = std::min(unread_.size(), buffer.size());
        std::copy_n(unread_.begin(), count, buffer.begin());
        unread_.erase(0, count);
        return count;
    }

    std::string written;

  private:
    std::deque<std::string> answers_;
    std::string unread_;
};

Error::Kind kind_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.kind();
    }
    throw std::logic_error("nothing was thrown");
}

std::string sentence_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

class EveryModel : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Driver, EveryModel,
                         testing::Values("URG-04LX", "UTM-30LX", "UST-10LX", "UST-20LX"),
                         [](const auto& model) {
                             std::string name = model.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(EveryModel, TellsWhatItIs) {
    const auto& profile = daemon::find_model(GetParam()).profile;
    ModelTransport transport(GetParam());
    Driver driver(transport);
    driver.connect();
    EXPECT_EQ(driver.version().serial, profile.serial);
    EXPECT_EQ(driver.parameters().model, profile.model);
    EXPECT_EQ(driver.parameters().amax, profile.amax);
    EXPECT_EQ(driver.state().laser, "OFF");
    driver.switch_laser_on();
    driver.switch_laser_on();
    EXPECT_EQ(driver.state().laser, "ON");
}

TEST_P(EveryModel, StreamsUntilToldToStop) {
    const auto& profile = daemon::find_model(GetParam()).profile;
    ModelTransport transport(GetParam(), 7);
    Driver driver(transport);
    driver.connect();
    driver.start({.first_step = profile.amin, .last_step = profile.amax});
    std::uint32_t last_stamp_ms = 0;
    for (int i = 0; i < 5; ++i) {
        const ScanMessage scan = driver.next_scan();
        ASSERT_EQ(scan.distances_mm.size(),
                  static_cast<std::size_t>(profile.amax - profile.amin + 1));
        EXPECT_EQ(scan.distances_mm.front(), 1000U + static_cast<std::uint32_t>(profile.amin));
        if (i > 0) {
            const std::chrono::milliseconds passed(scan.stamp_ms - last_stamp_ms);
            EXPECT_LT(std::chrono::abs(passed - profile.scan_period), 1ms);
        }
        last_stamp_ms = scan.stamp_ms;
    }
    EXPECT_TRUE(transport.device().laser_on());
    driver.stop();
    EXPECT_FALSE(transport.device().laser_on());
    EXPECT_EQ(driver.damaged_scans(), 0U);
    EXPECT_EQ(driver.version().serial, profile.serial);
}

TEST_P(EveryModel, CountsDownACountedStream) {
    ModelTransport transport(GetParam());
    Driver driver(transport);
    driver.connect();
    driver.start({.first_step = 100, .last_step = 110, .cluster = 3, .scans = 3});
    for (const int remaining : {2, 1, 0}) {
        const ScanMessage scan = driver.next_scan();
        EXPECT_EQ(scan.request.scans, remaining);
        EXPECT_THAT(scan.distances_mm, ElementsAre(1100, 1103, 1106, 1109));
    }
    EXPECT_EQ(kind_of([&] { (void)driver.next_scan(); }), Error::Kind::silent);
}

TEST_P(EveryModel, TellsItsTime) {
    ModelTransport transport(GetParam());
    Driver driver(transport);
    driver.connect();
    driver.enter_adjust();
    const std::uint32_t before_ms = driver.time_ms();
    const std::uint32_t after_ms = driver.time_ms();
    EXPECT_GE(after_ms, before_ms);
    EXPECT_LT(after_ms, before_ms + 1000);
    driver.leave_adjust();
    driver.reset();
}

TEST(Driver, ReadsMicrosecondsWhereTheFirmwareHasThem) {
    ModelTransport transport("UST-30LC@4.1.0b-A");
    transport.device().set_clock(0ms, 16'777'000ms);  // more than 24 bits soon
    Driver driver(transport);
    driver.connect();
    driver.start({.first_step = 540, .last_step = 541, .microseconds = true, .scans = 20});
    std::vector<std::uint64_t> stamps_us;
    for (int i = 0; i < 20; ++i)
        stamps_us.push_back(driver.next_scan().stamp_us);
    EXPECT_EQ(stamps_us[19] - stamps_us[0], 19U * 25'050U);
    EXPECT_GT(stamps_us[19], 16'777'216'000U);
    EXPECT_GT(driver.time_us(), stamps_us[19]);
    EXPECT_LT(driver.time_ms(), 10'000U);  // wrapped
    ModelTransport older("UST-30LC@4.0.3");
    Driver other(older);
    other.connect();
    EXPECT_EQ(kind_of([&] { (void)other.time_us(); }), Error::Kind::refused);
}

// A client before this one ended while its scans were coming, or in adjust mode.
TEST_P(EveryModel, IsFoundInWhateverStateItWasLeft) {
    for (const std::string left : {"MD0100020001000\n", "TM0\n", "BM\n", "M"}) {
        ModelTransport transport(GetParam());
        transport.write(left);
        std::array<char, 333> part{};
        (void)transport.read(part, 300ms);
        Driver driver(transport);
        driver.connect();
        EXPECT_FALSE(transport.device().laser_on()) << left;
        EXPECT_FALSE(transport.device().adjusting()) << left;
        EXPECT_GT(driver.parameters().ares, 0) << left;
    }
}

TEST(Driver, ReadsSingleScansAndIntensities) {
    ModelTransport transport("UTM-30LX");
    Driver driver(transport);
    driver.connect();
    const ScanRequest request{.first_step = 5, .last_step = 7, .intensity = true};
    EXPECT_EQ(sentence_of([&] { (void)driver.single_scan(request); }),
              "the scanner refused GE0005000701 with status 10: not in the present state; BM "
              "switches the laser on, which a single scan needs");
    driver.switch_laser_on();
    const ScanMessage scan = driver.single_scan(request);
    EXPECT_THAT(scan.distances_mm, ElementsAre(1005, 1006, 1007));
    EXPECT_THAT(scan.intensities, ElementsAre(2005, 2006, 2007));
}

TEST(Driver, TellsWhatTheScannerRefuses) {
    ModelTransport transport("UST-10LX");
    Driver driver(transport);
    driver.connect();
    EXPECT_EQ(sentence_of([&] { driver.start({.last_step = 1081}); }),
              "the scanner refused MD0000108101000 with status 04: the scanner has no such step");
    EXPECT_EQ(kind_of([&] { driver.start({.last_step = 10, .echoes = true}); }),
              Error::Kind::refused);
}

TEST(Driver, BringsAnOldScannerToScip20) {
    ScriptTransport transport({"QT\nE\n\n", "SCIP2.0\n0\n\n", "QT\n00P\n\n"});
    Driver(transport).connect();
    EXPECT_EQ(transport.written, "\nQT\nSCIP2.0\n\nQT\n");
}

TEST(Driver, TakesAScannerOutOfAdjustMode) {
    ScriptTransport transport({"QT\n0Ee\n\n", "TM2\n00P\n\n", "QT\n00P\n\n"});
    Driver(transport).connect();
    EXPECT_EQ(transport.written, "\nQT\nTM2\n\nQT\n");
}

TEST(Driver, AsksAgainWhereTheReplyHangsOnToHalfAScan) {
    ScriptTransport transport({"0^000CBQT\n00P\n\n", "QT\n00P\n\n"});
    Driver(transport).connect();
    EXPECT_EQ(transport.written, "\nQT\n\nQT\n");
}

TEST(Driver, SaysThatNothingAnswers) {
    ScriptTransport transport({});
    EXPECT_EQ(kind_of([&] { Driver(transport).connect(); }), Error::Kind::silent);
    EXPECT_EQ(sentence_of([&] { Driver(transport).connect(); }),
              "no answer to QT within 1 s; a scanner serves one client at a time: is another "
              "program connected?");
    EXPECT_EQ(sentence_of([&] { (void)Driver(transport).version(); }),
              "no answer to VV within 1 s");
    EXPECT_EQ(sentence_of([&] { (void)Driver(transport, {.scan = 1500ms}).next_scan(); }),
              "no scan within 1500 ms");
}

TEST(Driver, SaysWhatElseAnswers) {
    ScriptTransport transport({"SSH-2.0-OpenSSH_9.2\r\n"});
    EXPECT_EQ(sentence_of([&] { Driver(transport).connect(); }),
              "what answers there does not speak SCIP (waited for QT, heard "
              "\"SSH-2.0-OpenSSH_9.2..\")");
}

TEST(Driver, GivesUpOnSomebodyWhoNeverStops) {
    class Chatterbox : public Transport {
      public:
        void write(std::string_view) override {}
        std::size_t read(std::span<char> buffer, std::chrono::milliseconds) override {
            std::ranges::fill(buffer, 'a');
            return buffer.size();
        }
    } transport;
    EXPECT_EQ(kind_of([&] { Driver(transport).connect(); }), Error::Kind::foreign);
}

TEST(Driver, PassesOverDamagedScansAndCountsThem) {
    const std::string good = "MD0000000001000\n99b\n00011\n1DhM\n\n";
    std::string bad = good;
    bad[bad.find("1Dh")] = '2';
    ScriptTransport transport({"MD0000000001000\n00P\n\n" + bad + good});
    Driver driver(transport);
    driver.start({});
    EXPECT_THAT(driver.next_scan().distances_mm, ElementsAre(5432));
    EXPECT_EQ(driver.damaged_scans(), 1U);
}

TEST(Driver, TellsThatTheScannerEndedTheStream) {
    ScriptTransport transport(
        {"MD0000000001000\n00P\n\nMD0000000001000\n0M]\n\n"
         "MD0000000001000\n52W\n\n"});
    Driver driver(transport);
    driver.start({});
    EXPECT_EQ(sentence_of([&] { (void)driver.next_scan(); }),
              "the stream has ended with status 52: the laser or the motor is out of order");
}

}  // namespace
}  // namespace scipd::protocol::client
