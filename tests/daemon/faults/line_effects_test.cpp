// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What effects do to a line: to its state, and to a TCP port and a tty with clients.
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"
#include "tests/daemon/faults/fake_scene.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::ScannerWire;
namespace fs = std::filesystem;

LineState line_of(const std::string& kind, const std::string& members,
                  const LinkConfig& link = {}) {
    LineState line{.link = link};
    effect_of(kind, members)->line(line);
    return line;
}

TEST(LineEffects, AddToWhatTheLineDoes) {
    EXPECT_EQ(line_of("delay", "{ms: 5, jitter_ms: 2}", {.latency = 3ms}),
              (LineState{.link = {.latency = 8ms, .jitter = 2ms}}));
    EXPECT_EQ(line_of("coalesce", "{ms: 5}", {.coalesce = 9ms}),
              (LineState{.link = {.coalesce = 9ms}}));
    EXPECT_EQ(line_of("coalesce", "{ms: 5}"), (LineState{.link = {.coalesce = 5ms}}));
    EXPECT_EQ(line_of("split", "{bytes: {every: 7}}", {.split_bytes = 9}),
              (LineState{.link = {.split_bytes = 7, .split_pause = 2ms}}));
    EXPECT_EQ(line_of("split", "{bytes: {at: [9, 3, 9]}, pause_ms: 4}", {.split_bytes = 9}),
              (LineState{.link = {.split_bytes = 9, .split_at = {3, 9}, .split_pause = 4ms}}));
    EXPECT_EQ(line_of("stall", "{}"), LineState{.stalled = true});
    EXPECT_EQ(line_of("cut", "{}"), LineState{.refuses = true});
    EXPECT_EQ(line_of("cut", "{how: fin}"), LineState{.refuses = true});
    EXPECT_EQ(line_of("cut", "{how: refuse, for: {s: 1}}"), LineState{.refuses = true});
    EXPECT_EQ(line_of("cut", "{how: silent, for: {s: 1}}"), LineState{.dead = true});
    EXPECT_EQ(line_of("cut", "{how: mute, for: {s: 1}}"), LineState{.dead = true});
    EXPECT_EQ(line_of("hangup", "{}"), LineState{.hung_up = true});
}

TEST(LineEffects, TellWhatTheyTouch) {
    FakeScene scene;
    protocol::Send message{"0123456789"};
    effect_of("split", "{bytes: {every: 4}}")->bytes(message, scene);
    EXPECT_THAT(scene.touches.back().bytes, ElementsAre(4, 8));
    effect_of("split", "{bytes: {at: [9, 3, 10]}}")->bytes(message, scene);
    EXPECT_THAT(scene.touches.back().bytes, ElementsAre(3, 9));
    EXPECT_EQ(scene.touches.back().what, "split into 3 pieces");
    effect_of("split", "{bytes: {every: 10}}")->bytes(message, scene);
    EXPECT_EQ(scene.touches.size(), 2U);
    for (const std::string kind : {"delay", "coalesce"})
        effect_of(kind, "{ms: 1}")->bytes(message, scene);
    effect_of("stall", "{}")->bytes(message, scene);
    EXPECT_EQ(scene.touches.size(), 5U);
    EXPECT_EQ(message.bytes, "0123456789");
}

TEST(LineEffects, SayWhatIsWrongWithTheirMembers) {
    EXPECT_THAT(refusal("delay", "{}"), HasSubstr("needs ms"));
    EXPECT_THAT(refusal("delay", "{ms: 10001}"), HasSubstr("must be 0 to 10000 ms"));
    EXPECT_THAT(refusal("coalesce", "{}"), HasSubstr("needs ms"));
    EXPECT_THAT(refusal("split", "{}"), HasSubstr("needs either bytes: {at"));
    EXPECT_THAT(refusal("split", "{bytes: {at: [1], every: 2}}"), HasSubstr("needs either"));
    EXPECT_THAT(refusal("split", "{bytes: {at: [0]}}"), HasSubstr("from 1 to 65535"));
    EXPECT_THAT(refusal("stall", "{ms: 1}"), HasSubstr("ms"));
    EXPECT_THAT(refusal("cut", "{how: gently}"),
                HasSubstr("must be one of fin, rst, silent, refuse, mute, not 'gently'"));
    EXPECT_THAT(refusal("cut", "{how: mute}"), HasSubstr("needs for: a cut"));
}

class CutEffects : public testing::Test {
  protected:
    CutEffects() {
        tcp_->serve(device_);
        tty_->serve(device_);
    }
    ~CutEffects() override {
        tcp_->stop();
        tty_->stop();
        io_.restart();
        io_.run_for(10ms);
    }

    /// As the injector does it.
    void begin(FaultEffect& effect) {
        effect.begin(scene_);
        set_line([&](LineState& line) { effect.line(line); });
    }
    void end(FaultEffect& effect) {
        effect.end(scene_);
        set_line([](LineState&) {});
    }
    template <class Change>
    void set_line(Change change) {
        LineState line;
        change(line);
        tcp_->set_line(line);
        tty_->set_line(line);
    }

    [[nodiscard]] ScannerWire connect() const {
        return ScannerWire::tcp(tests::port_of(tcp_->address()));
    }
    bool is_answered(ScannerWire& wire) {
        wire.write("QT\n");
        return receives(wire, "QT\n00P\n\n");
    }
    bool receives(ScannerWire& wire, const std::string& text) {
        std::string received;
        return run_until(io_, [&] {
            std::array<char, 1024> buffer;
            received.append(buffer.data(), wire.read(buffer, 0ms));
            return received == text;
        });
    }
    bool is_silent(ScannerWire& wire) {
        wire.write("QT\n");
        io_.restart();
        io_.run_for(50ms);
        std::array<char, 1024> buffer;
        return wire.read(buffer, 0ms) == 0;
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
    bool has_tty() {
        io_.restart();
        io_.run_for(20ms);
        return fs::is_character_file(link_);
    }

    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    tests::TempDir directory_;
    fs::path link_ = directory_.path() / "tty";
    std::shared_ptr<TcpPort> tcp_ =
        std::make_shared<TcpPort>(io_.get_executor(), Address{"127.0.0.1", 0});
    std::shared_ptr<PtyPort> tty_ = std::make_shared<PtyPort>(io_.get_executor(), link_);
    FakeScene scene_{1, &device_, {tcp_.get(), tty_.get()}};
};

TEST_F(CutEffects, EndConnectionsAndRefuseOthersWhileTheyLast) {
    for (const std::string how : {"fin", "rst"}) {
        ScannerWire net = connect();
        ScannerWire tty = ScannerWire::tty(link_);
        EXPECT_TRUE(is_answered(net) && is_answered(tty));
        const auto cut = effect_of("cut", "{how: " + how + "}");
        begin(*cut);
        EXPECT_THAT(scene_.touches.back().what, HasSubstr("clients cut off: 2"));
        EXPECT_TRUE(is_cut_off(net));
        EXPECT_TRUE(is_cut_off(tty));
        EXPECT_THROW((void)connect(), std::system_error);
        EXPECT_FALSE(has_tty());
        end(*cut);
        EXPECT_TRUE(has_tty());
        ScannerWire next = connect();
        EXPECT_TRUE(is_answered(next));
    }
}

TEST_F(CutEffects, RefuseOnlyWhoConnects) {
    ScannerWire net = connect();
    EXPECT_TRUE(is_answered(net));
    const auto cut = effect_of("cut", "{how: refuse, for: {s: 1}}");
    begin(*cut);
    EXPECT_TRUE(is_answered(net));
    EXPECT_THROW((void)connect(), std::system_error);
    end(*cut);
    EXPECT_TRUE(is_answered(net));
}

TEST_F(CutEffects, FallSilentAndResetTheConnectionAtTheEnd) {
    ScannerWire net = connect();
    ScannerWire tty = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(net) && is_answered(tty));
    const auto cut = effect_of("cut", "{how: silent, for: {s: 1}}");
    begin(*cut);
    EXPECT_TRUE(is_silent(net));
    EXPECT_TRUE(is_silent(tty));
    end(*cut);
    EXPECT_TRUE(is_cut_off(net));
    EXPECT_TRUE(is_answered(tty));
    ScannerWire next = connect();
    EXPECT_TRUE(is_answered(next));
}

TEST_F(CutEffects, AnswerNobodyAndGoOn) {
    const auto cut = effect_of("cut", "{how: mute, for: {s: 1}}");
    begin(*cut);
    ScannerWire net = connect();
    EXPECT_TRUE(is_silent(net));
    end(*cut);
    EXPECT_TRUE(is_answered(net));
}

TEST_F(CutEffects, BootTheDeviceAtTheEnd) {
    const auto cut = effect_of("cut", "{boot: true}");
    begin(*cut);
    EXPECT_EQ(scene_.boots, 0);
    end(*cut);
    EXPECT_EQ(scene_.boots, 1);
}

TEST_F(CutEffects, HangUpTtysAlone) {
    ScannerWire net = connect();
    ScannerWire tty = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(net) && is_answered(tty));
    const auto hangup = effect_of("hangup", "{}");
    begin(*hangup);
    EXPECT_EQ(scene_.touches.back().what, "the tty hangs up");
    EXPECT_TRUE(is_cut_off(tty));
    EXPECT_FALSE(has_tty());
    EXPECT_TRUE(is_answered(net));
    end(*hangup);
    EXPECT_TRUE(has_tty());
    ScannerWire next = ScannerWire::tty(link_);
    EXPECT_TRUE(is_answered(next));

    FakeScene without{1, &device_, {tcp_.get()}};
    hangup->begin(without);
    EXPECT_EQ(without.touches.back().what, "there is no tty to hang up");
}

TEST_F(CutEffects, MakeNoiseToWhoIsThereAndWhoConnects) {
    const auto noise = effect_of("noise", "{count: 3}");
    ScannerWire net = connect();
    EXPECT_TRUE(is_answered(net));
    noise->begin(scene_);
    EXPECT_TRUE(receives(net, std::string(3, '\0')));
    EXPECT_EQ(scene_.touches.size(), 1U);  // nobody has the tty open
    noise->connected(*tcp_, scene_);
    EXPECT_TRUE(receives(net, std::string(3, '\0')));
    const auto random = effect_of("noise", "{count: 8, value: random}");
    std::string expected;
    for (std::uint32_t i = 0; i < 8; ++i)
        expected += static_cast<char>(static_cast<unsigned char>(scene_.chance(i) * 256.0));
    random->begin(scene_);
    EXPECT_TRUE(receives(net, expected));
    EXPECT_EQ(scene_.touches.back().what, "8 bytes of noise");
}

}  // namespace
}  // namespace scipd::daemon
