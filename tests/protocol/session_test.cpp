// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One client and its device. What each reply looks like is the dialogues' business; here is when it
// comes and what becomes of the device.
#include "protocol/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/command_table.h"
#include "tests/protocol/shell.h"
#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::StartsWith;

DeviceProfile prompt(Family family = Family::ust) {
    DeviceProfile profile = test_profile(family);
    profile.reply_tick = profile.scan_tick = 0ms;
    return profile;
}

/// Instant and echo of every message.
std::vector<std::pair<Uptime, std::string>> told(Shell& shell, int client = 0) {
    std::vector<std::pair<Uptime, std::string>> all;
    for (const Sent& sent : shell.take_sent(client))
        all.emplace_back(sent.at, sent.bytes.substr(0, sent.bytes.find('\n')));
    return all;
}

using Told = std::pair<Uptime, std::string>;

std::string ask(Shell& shell, const std::string& request, int client = 0) {
    shell.receive(request + "\n", client);
    return shell.take_text(client);
}

std::string next_bytes(Session& session) {
    return std::get<Send>(session.next_action().value()).bytes;
}

TEST(Session, AnswersOneRequestATick) {
    Shell shell(test_profile());
    shell.advance_to(300us);
    shell.receive("QT\nRS\rBM\r\n");
    EXPECT_EQ(shell.session().wake_at(), 1ms);
    EXPECT_THAT(told(shell), IsEmpty());
    shell.advance_to(10ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{1ms, "QT"}, Told{2ms, "RS"}, Told{3ms, "BM"}));
    EXPECT_EQ(shell.session().wake_at(), std::nullopt);
}

TEST(Session, ARequestRightAfterAReplyWaitsAWholeTick) {
    Shell shell(test_profile());
    shell.receive("QT\n");
    shell.advance_to(1ms);
    shell.receive("BM\n");
    EXPECT_EQ(shell.session().wake_at(), 2ms);
}

TEST(Session, InAdjustModeAnOldModelDoesNotWaitForItsMirror) {
    DeviceProfile profile = test_profile(Family::utm_usb);
    profile.reply_tick = 25ms;
    Shell shell(profile);
    shell.receive("TM0\nTM1\nTM2\nBM\n");
    shell.advance_to(100ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{25ms, "TM0"}, Told{26ms, "TM1"}, Told{27ms, "TM2"},
                                         Told{50ms, "BM"}));
}

TEST(Session, WithoutAGridItAnswersAtOnce) {
    Shell shell(prompt());
    shell.advance_to(333us);
    EXPECT_EQ(ask(shell, "BM\nBM"), "BM\n00P\n\nBM\n02R\n\n");
}

TEST(Session, CountsTheStatusesOfRequestsThatItRefuses) {
    Shell shell(prompt());
    EXPECT_THAT(shell.session().refused(), IsEmpty());
    for (const char* request : {"BM", "BM", "TM7", "BM", "VV", "QT"})
        ask(shell, request);
    EXPECT_THAT(shell.session().refused(), ElementsAre(Pair("01", 1), Pair("02", 2)));
    shell.session().close();
    EXPECT_THAT(shell.session().refused(), ElementsAre(Pair("01", 1), Pair("02", 2)));
}

TEST(Session, IsSilentOnEmptyLines) {
    Shell shell(prompt());
    EXPECT_EQ(ask(shell, "\r\n\n\r"), "");
    EXPECT_EQ(shell.session().wake_at(), std::nullopt);
}

TEST(Session, GrowsFullOfRequestsThatWait) {
    Shell shell(test_profile());
    for (int i = 0; i < 63; ++i)
        shell.receive("VV\n");
    EXPECT_FALSE(shell.session().full());
    shell.receive("VV\n");
    EXPECT_TRUE(shell.session().full());
    shell.advance_to(1ms);
    EXPECT_FALSE(shell.session().full());
    shell.advance_to(64ms);
    EXPECT_EQ(shell.take_sent().size(), 64U);  // nothing was lost
}

TEST(Session, TheReplyLooksTheSameHoweverTheRequestCame) {
    for (std::size_t piece = 1; piece < 12; ++piece) {
        Shell shell(prompt());
        std::string_view bytes = "\nVV\r\nQT;x\nXX\n";
        while (!bytes.empty()) {
            shell.receive(bytes.substr(0, piece));
            bytes.remove_prefix(std::min(piece, bytes.size()));
        }
        EXPECT_EQ(shell.take_text(),
                  "VV\n00P\nVEND:Nobody;B\nPROD:Test;?\nFIRM:1.0;g\nPROT:SCIP 2.2;P\nSERI:H1;V\n\n"
                  "QT;x\n00P\n\nXX\n0Ee\n\n");
    }
}

TEST(Session, TimeIsThatOfTheTickAndNotOfALateShell) {
    DeviceState device;
    const DeviceProfile profile = test_profile();
    Session session(profile, device);
    session.receive("TM1\n", 4'500us);
    session.advance(900ms);
    EXPECT_EQ(next_bytes(session), "TM1\n00P\n00055\n\n");
}

TEST(Session, AnswersAsItsModelDoesWhereThatDiffersFromItsFamily) {
    DeviceProfile profile = prompt();
    profile.deviations = {*parse_deviation("QT adjust --"), *parse_deviation("BM measuring 00")};
    Shell shell(profile);
    ask(shell, "TM0");
    EXPECT_EQ(ask(shell, "QT"), "QT\n00P\n\n");
    EXPECT_FALSE(shell.device().adjusting());
    ask(shell, "BM");
    EXPECT_EQ(ask(shell, "BM"), "BM\n00P\n\n");
}

// Streams.

TEST(Session, AStreamSendsScansAfterTheirLastStepOnTheGrid) {
    Shell shell(test_profile());
    shell.advance_to(30ms);
    shell.receive("MD0002000301000\n");
    shell.advance_to(100ms);
    EXPECT_THAT(told(shell),
                ElementsAre(Told{31ms, "MD0002000301000"},  // the acknowledgement
                            Told{69ms, "MD0002000301000"}, Told{94ms, "MD0002000301000"}));
    EXPECT_EQ(shell.scans_made, 2);
}

TEST(Session, MessagesOfAStreamMayBeDroppedAndRepliesNot) {
    Shell shell(prompt());
    shell.receive("MD0002000301001\nBM\nGD0002000301\n");
    shell.advance_to(60ms);
    std::vector<Send::Kind> kinds;
    for (const Sent& sent : shell.take_sent())
        kinds.push_back(sent.kind);
    EXPECT_THAT(kinds, ElementsAre(Send::Kind::reply, Send::Kind::reply, Send::Kind::reply,
                                   Send::Kind::scan));
}

TEST(Session, ACountedStreamEndsWithLaserOff) {
    Shell shell(prompt());
    ask(shell, "BM");
    ask(shell, "MD0002000301002");
    shell.advance_to(18'750us);
    EXPECT_THAT(shell.take_text(), StartsWith("MD0002000301001\n99b\n"));
    EXPECT_TRUE(shell.device().laser_on());
    shell.advance_to(200ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{43'750us, "MD0002000301000"}));
    EXPECT_FALSE(shell.device().laser_on());
    EXPECT_FALSE(shell.session().measuring());
    EXPECT_EQ(shell.scans_made, 2);
    EXPECT_EQ(ask(shell, "GD0002000301"), "GD0002000301\n10Q\n\n");
}

TEST(Session, NobodyLookingMeansNoScans) {
    Shell shell(prompt());
    ask(shell, "BM\nVV\nII");
    EXPECT_FALSE(shell.session().measuring());
    shell.advance_to(1s);
    EXPECT_EQ(shell.scans_made, 0);
}

TEST(Session, AnIntervalPassesOverTurnsWithoutScanningThem) {
    Shell shell(prompt());
    ask(shell, "BM");
    shell.advance_to(30ms);
    ask(shell, "MD0002000301200");
    shell.advance_to(300ms);
    // Turn 1 is under way; 3, 6 and 9 come.
    EXPECT_THAT(told(shell),
                ElementsAre(Told{93'750us, "MD0002000301200"}, Told{168'750us, "MD0002000301200"},
                            Told{243'750us, "MD0002000301200"}));
    EXPECT_EQ(shell.scans_made, 3);
}

// A recorded UTM-30LX, laser on: the request comes right after a reply; 24.5 ms later the
// acknowledgement, another 27 ms later the scan of the turn that begins then. (Here both are 25 ms:
// the grid has no width.)
TEST(Session, IntervalOneOfASlowModelSendsTheTurnAfterTheAcknowledgement) {
    DeviceProfile profile = test_profile(Family::utm_usb);
    profile.turns_per_reply = 1;
    Shell shell(profile);
    shell.receive("BM\n");
    shell.advance_to(25'500us);
    shell.take_sent();
    shell.receive("ME0002000301101\n");
    shell.advance_to(200ms);
    const auto sent = shell.take_sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[0].at, 50ms);
    EXPECT_EQ(sent[1].at, 75ms);
    EXPECT_THAT(sent[1].bytes, StartsWith("ME0002000301100\n99b\n000bb\n"));  // 50 ms
}

TEST(Session, ASlowerMotorSlowsScansAndRepliesFromTheNextTurnOn) {
    DeviceProfile profile = test_profile(Family::urg);
    profile.motor_levels = true;
    profile.turns_per_reply = 1;
    Shell shell(profile);
    shell.receive("MD0002000301000\n");
    shell.advance_to(30ms);
    shell.receive("CR10\n");  // answered at 50 ms
    shell.advance_to(131ms);
    EXPECT_THAT(told(shell),
                ElementsAre(Told{25ms, "MD0002000301000"}, Told{50ms, "MD0002000301000"},
                            Told{51ms, "CR10"}, Told{75ms, "MD0002000301000"},
                            Told{75ms + 27'777'777ns, "MD0002000301000"},
                            Told{75ms + 2 * 27'777'777ns, "MD0002000301000"}));
    shell.receive("RS\n");
    shell.advance_to(1s);
    shell.receive("BM\n");
    shell.advance_to(1100ms);
    // Once more at the slow pace, then 25 ms again from 75 ms + 4 * 27.777777 ms on.
    EXPECT_THAT(told(shell), ElementsAre(Told{75ms + 3 * 27'777'777ns, "MD0002000301000"},
                                         Told{76ms + 3 * 27'777'777ns, "RS"},
                                         Told{75ms + 4 * 27'777'777ns + 33 * 25ms, "BM"}));
}

TEST(Session, ANewStreamReplacesTheOldOne) {
    Shell shell(prompt(Family::utm_usb));
    ask(shell, "MD0002000301005");
    shell.advance_to(50ms);
    shell.take_sent();
    EXPECT_EQ(ask(shell, "ME0004000501002"), "ME0004000501002\n00P\n\n");
    shell.advance_to(300ms);
    EXPECT_THAT(told(shell),
                ElementsAre(Told{68'750us, "ME0004000501001"}, Told{93'750us, "ME0004000501000"}));
}

TEST(Session, AFaultyRequestLeavesTheStreamAlone) {
    Shell shell(prompt());
    ask(shell, "MD0002000301000");
    EXPECT_EQ(ask(shell, "MD0002000x01000"), "MD0002000x01000\n02R\n\n");
    shell.advance_to(20ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{18'750us, "MD0002000301000"}));
}

TEST(Session, TheReplacedStreamsScanIsNotHandedToItsSuccessor) {
    DeviceState device;
    const DeviceProfile profile = prompt();
    const std::vector<std::uint32_t> scan(8, 1000);
    Session session(profile, device);
    session.receive("MD0002000301000\n", 0ms);
    ASSERT_TRUE(session.turn_complete({0ms}));
    session.receive("MD0002000301900\n", 20ms);  // while the scan is being made
    session.take({{0ms}, 2, scan, scan}, 21ms);
    EXPECT_EQ(next_bytes(session), "MD0002000301000\n00P\n\n");
    EXPECT_EQ(next_bytes(session), "MD0002000301900\n00P\n\n");
    EXPECT_EQ(session.next_action(), std::nullopt);
}

TEST(Session, TwoScansMayBeUnderWayAtOnce) {
    DeviceState device;
    const DeviceProfile profile = prompt();
    const std::vector<std::uint32_t> scan(8, 1000);
    Session session(profile, device);
    session.receive("MD0002000301001\n", 0ms);
    ASSERT_TRUE(session.turn_complete({0ms}));
    ASSERT_TRUE(session.turn_complete({25ms}));
    session.take({{0ms}, 2, scan, scan}, 45ms);
    session.take({{25ms}, 2, scan, scan}, 46ms);
    ASSERT_TRUE(session.next_action());  // the acknowledgement
    EXPECT_THAT(next_bytes(session), StartsWith("MD0002000301000\n99b\n"));
    EXPECT_EQ(session.next_action(), std::nullopt);  // only one was asked for
}

TEST(Session, QuitEndsTheStreamAtOnce) {
    Shell shell(prompt());
    ask(shell, "MD0002000301000");
    shell.advance_to(50ms);
    shell.take_sent();
    EXPECT_EQ(ask(shell, "QT"), "QT\n00P\n\n");
    shell.advance_to(200ms);
    EXPECT_THAT(told(shell), IsEmpty());
    EXPECT_FALSE(shell.device().laser_on());
}

TEST(Session, AScanUnderWayIsDroppedByQuit) {
    Shell shell(test_profile());
    shell.receive("MD0002000301000\n");
    shell.advance_to(43'760us);  // turn 1, the first with laser, has fired its last step
    shell.receive("QT\n");
    shell.advance_to(200ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{1ms, "MD0002000301000"},
                                         Told{44ms, "MD0002000301000"}, Told{45ms, "QT"}));
}

// Clients that stop reading at the empty line behind a scan wait for ever for a reply that came
// with it.
TEST(Session, AReplyFollowsAScanAfterAPause) {
    DeviceProfile profile = test_profile(Family::urg);
    profile.turns_per_reply = 1;
    Shell shell(profile);
    shell.receive("MD0002000301000\n");
    shell.advance_to(60ms);
    shell.receive("QT\nVV\n");  // their turn is when a scan leaves
    shell.advance_to(200ms);
    EXPECT_THAT(told(shell),
                ElementsAre(Told{25ms, "MD0002000301000"}, Told{50ms, "MD0002000301000"},
                            Told{75ms, "MD0002000301000"}, Told{76ms, "QT"}, Told{77ms, "VV"}));
    Shell counted(prompt());
    counted.receive("MD0002000301001\n");
    counted.advance_to(19ms);  // the only one left at 18.75 ms
    counted.receive("QT\n");
    counted.advance_to(50ms);
    EXPECT_EQ(told(counted).back(), (Told{19'750us, "QT"}));
}

TEST(Session, ResetEndsTheStreamAndSetsTheClockToZero) {
    Shell shell(prompt());
    ask(shell, "MD0002000301000");
    shell.advance_to(1s);
    shell.take_sent();
    EXPECT_EQ(ask(shell, "RS"), "RS\n00P\n\n");
    shell.advance_to(2s);
    EXPECT_THAT(told(shell), IsEmpty());
    EXPECT_EQ(ask(shell, "TM1"), "TM1\n00P\n00?Xg\n\n");  // 1000 ms
}

TEST(Session, AStampAndTheClockWrapTogether) {
    Shell shell(prompt());
    shell.advance_to(16'777'216ms);  // 24 bits of ms; turn 671088 begins 16 ms before, so it is the
                                     // next that is whole
    ask(shell, "MD0002000201001");
    shell.advance_to(16'777'300ms);
    EXPECT_EQ(shell.take_text(), "MD0002000201000\n99b\n00099\n0?X7\n\n");
}

// Single shots.

TEST(Session, ASingleShotIsTheLatestCompleteScan) {
    Shell shell(prompt());
    ask(shell, "BM");
    shell.advance_to(130ms);  // turn 4 began at 100 ms and is complete, turn 5 is not
    EXPECT_EQ(ask(shell, "GD0002000301"), "GD0002000301\n00P\n001TU\n0?X0?X>\n\n");
    EXPECT_EQ(shell.scans_made, 1);
    EXPECT_TRUE(shell.device().laser_on());
}

TEST(Session, ASingleShotRightAfterBmWaitsForAWholeTurnWithLaser) {
    Shell shell(prompt());
    shell.advance_to(5ms);
    ask(shell, "BM");
    EXPECT_EQ(ask(shell, "GD0002000201\nVV"), "");
    EXPECT_TRUE(shell.session().measuring());
    shell.advance_to(100ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{43'750us, "GD0002000201"}, Told{43'750us, "VV"}));
    EXPECT_FALSE(shell.session().measuring());
}

// Turns of 25 ms begin at 50 ms, 5 ms before the laser has settled, and at 75 ms.
TEST(Session, ATurnThatBeginsBeforeTheLaserHasSettledHasNoScan) {
    DeviceProfile profile = prompt();
    profile.settle_time = 50ms;
    for (const std::string request : {"MD0002000301000", "BM\nGD0002000301"}) {
        Shell shell(profile);
        shell.advance_to(5ms);
        ask(shell, request);
        shell.advance_to(90ms);
        EXPECT_THAT(told(shell), IsEmpty()) << request;
        shell.advance_to(95ms);
        EXPECT_THAT(told(shell), ElementsAre(Pair(93'750us, testing::_))) << request;
    }
}

TEST(Session, OldModelsAnswerASingleShotWithinAStream) {
    Shell shell(prompt(Family::utm_usb));
    ask(shell, "BM");
    shell.advance_to(60ms);
    ask(shell, "MD0002000301000");
    EXPECT_THAT(ask(shell, "GD0002000301"),
                StartsWith("GD0002000301\n00P\n000II\n"));  // turn 1 of 25 ms
    shell.advance_to(70ms);
    EXPECT_THAT(told(shell), ElementsAre(Told{68'750us, "MD0002000301000"}));
}

TEST(Session, TheLastScanOfAStreamAnswersASingleShotToo) {
    Shell shell(prompt(Family::utm_usb));
    ask(shell, "MD0002000301001");
    EXPECT_EQ(ask(shell, "GD0002000301"), "");
    shell.advance_to(100ms);
    EXPECT_THAT(told(shell),
                ElementsAre(Told{18'750us, "MD0002000301000"}, Told{18'750us, "GD0002000301"}));
    EXPECT_EQ(shell.scans_made, 1);
}

// Two clients of one device.

TEST(Session, ClientsShareLaserClockAndMode) {
    Shell shell(prompt(), 2);
    ask(shell, "BM", 0);
    EXPECT_EQ(ask(shell, "BM", 1), "BM\n02R\n\n");
    shell.advance_to(10ms);
    ask(shell, "RS", 1);
    EXPECT_EQ(ask(shell, "GD0002000301", 0), "GD0002000301\n10Q\n\n");
    EXPECT_EQ(ask(shell, "TM1", 0), "TM1\n00P\n00000\n\n");
    ask(shell, "TM0", 1);
    EXPECT_EQ(ask(shell, "PP", 0), "PP\n10Q\n\n");
}

TEST(Session, AStreamBelongsToItsClient) {
    Shell shell(prompt(), 2);
    ask(shell, "MD0002000301000", 0);
    ask(shell, "ME0002000301001", 1);
    shell.advance_to(60ms);
    EXPECT_THAT(told(shell, 0),
                ElementsAre(Told{18'750us, "MD0002000301000"}, Told{43'750us, "MD0002000301000"}));
    EXPECT_THAT(told(shell, 1), ElementsAre(Told{18'750us, "ME0002000301000"}));
    EXPECT_EQ(ask(shell, "QT", 1), "QT\n00P\n\n");
    shell.advance_to(70ms);
    EXPECT_THAT(told(shell, 0), ElementsAre(Told{68'750us, "MD0002000301000"}));
    ask(shell, "QT", 0);
    EXPECT_FALSE(shell.device().laser_on());
}

TEST(Session, ASingleShotWhoseLaserTheOtherSwitchesOffIsRefused) {
    Shell shell(prompt(), 2);
    ask(shell, "BM\nGD0002000301\nVV", 0);
    shell.advance_to(10ms);
    EXPECT_EQ(shell.take_text(0), "");
    ask(shell, "QT", 1);
    shell.advance_to(11ms);
    EXPECT_THAT(told(shell, 0), ElementsAre(Told{10ms, "GD0002000301"}, Told{10ms, "VV"}));
    EXPECT_EQ(shell.scans_made, 0);
}

TEST(Session, ClosingEndsWhatItsClientBegan) {
    Shell shell(prompt(), 2);
    ask(shell, "MD0002000301000", 0);
    shell.session(0).close();
    EXPECT_FALSE(shell.session(0).measuring());
    EXPECT_FALSE(shell.device().laser_on());
    ask(shell, "TM0", 0);
    shell.session(0).close();
    EXPECT_FALSE(shell.device().adjusting());
}

TEST(Session, ClosingLeavesAloneWhatTheOtherBegan) {
    Shell shell(prompt(), 2);
    ask(shell, "BM", 0);
    ask(shell, "VV", 1);
    shell.session(1).close();
    EXPECT_TRUE(shell.device().laser_on());
    ask(shell, "MD0002000301000", 1);
    shell.session(0).close();
    shell.advance_to(20ms);
    EXPECT_THAT(told(shell, 1), ElementsAre(Told{18'750us, "MD0002000301000"}));
}

TEST(Session, ClosingForgetsWhatWasAskedAndWhatWasToBeSent) {
    DeviceState device;
    const DeviceProfile profile = test_profile();
    Session session(profile, device);
    session.receive("VV\nPP\nBM", 0ms);
    session.advance(1ms);
    session.close();
    EXPECT_EQ(session.next_action(), std::nullopt);
    EXPECT_EQ(session.wake_at(), std::nullopt);
    session.receive("VV\n", 5ms);  // the half of BM is forgotten too
    session.advance(6ms);
    EXPECT_THAT(next_bytes(session), StartsWith("VV\n00P\n"));
}

// The device's power and trouble.

TEST(Session, ARebootDropsEveryLinkAfterAllThatWasSent) {
    Shell shell(prompt(), 2);
    ask(shell, "MD0002000301000", 0);
    shell.advance_to(20ms);
    ask(shell, "RB\nRB", 1);
    shell.advance_to(1019ms);
    EXPECT_THAT(shell.take_other_actions(0), IsEmpty());
    shell.advance_to(1020ms);
    EXPECT_THAT(shell.take_other_actions(0), ElementsAre(Action(DropLink{})));
    EXPECT_THAT(shell.take_other_actions(1), ElementsAre(Action(DropLink{})));
    EXPECT_FALSE(shell.session(0).measuring());
    shell.take_text(0);
    shell.advance_to(10s);
    EXPECT_THAT(told(shell, 0), IsEmpty());
    EXPECT_EQ(ask(shell, "BM", 0), "BM\n00P\n\n");
}

TEST(Session, ASessionThatBeginsAfterABootHasLostNothing) {
    DeviceState device;
    device.boot(0ms, 5s);
    const DeviceProfile profile = prompt();
    Session session(profile, device);
    session.receive("VV\n", 1ms);
    EXPECT_EQ(session.wake_at(), 5s);
    session.advance(5s);
    EXPECT_THAT(next_bytes(session), StartsWith("VV\n00P\n"));
}

TEST(Session, TheRateOfTheLineChangesAfterTheReply) {
    DeviceState device;
    DeviceProfile profile = prompt(Family::urg);
    profile.bit_rates = {19200, 115200};
    Session session(profile, device);
    session.receive("SS115200\nRS\n", 0ms);
    EXPECT_EQ(next_bytes(session), "SS115200\n00P\n\n");
    EXPECT_EQ(session.next_action(), Action(SetBitRate{115200}));
    EXPECT_EQ(next_bytes(session), "RS\n00P\n\n");
    EXPECT_EQ(session.next_action(), Action(SetBitRate{19200}));
    EXPECT_EQ(session.next_action(), std::nullopt);
}

TEST(Session, EverySessionIsToldOnceOfAnotherRate) {
    DeviceProfile profile = prompt(Family::urg);
    profile.bit_rates = {19200, 115200};
    Shell shell(profile, 2);
    ask(shell, "SS115200", 1);
    EXPECT_EQ(shell.session(0).wake_at(), 0ms);  // now, not with the next request
    EXPECT_THAT(shell.take_other_actions(1), ElementsAre(Action(SetBitRate{115200})));
    shell.advance_to(1ms);
    EXPECT_THAT(shell.take_other_actions(0), ElementsAre(Action(SetBitRate{115200})));
    ask(shell, "RS", 0);
    ask(shell, "RS", 0);
    shell.advance_to(2ms);
    EXPECT_THAT(shell.take_other_actions(0), ElementsAre(Action(SetBitRate{19200})));
    EXPECT_THAT(shell.take_other_actions(1), ElementsAre(Action(SetBitRate{19200})));
    EXPECT_EQ(shell.session(1).wake_at(), std::nullopt);
}

TEST(Session, ARateThatChangesUnderARequestThatWaitsIsToldInOrder) {
    DeviceState device;
    DeviceProfile profile = prompt(Family::urg);
    profile.bit_rates = {19200, 115200};
    Session one(profile, device);
    Session other(profile, device);
    one.receive("VV\n", 0ms);
    other.receive("SS115200\n", 1ms);
    one.receive("QT\n", 2ms);
    EXPECT_THAT(next_bytes(one), StartsWith("VV\n"));
    EXPECT_EQ(one.next_action(), Action(SetBitRate{115200}));
    EXPECT_THAT(next_bytes(one), StartsWith("QT\n"));
}

TEST(Session, ABootTakesTheRateBack) {
    DeviceProfile profile = prompt(Family::urg);
    profile.bit_rates = {19200, 115200};
    Shell shell(profile, 1);
    ask(shell, "SS115200");
    shell.take_other_actions();
    shell.device().boot(1ms, 5s);
    shell.advance_to(1ms);
    EXPECT_THAT(shell.take_other_actions(),
                ElementsAre(Action(DropLink{}), Action(SetBitRate{19200})));
}

TEST(Session, ARateThatWasNotFetchedOutlivesItsClient) {
    DeviceState device;
    DeviceProfile profile = prompt(Family::urg);
    profile.bit_rates = {19200, 115200};
    Session session(profile, device);
    session.receive("SS115200\nVV\n", 0ms);
    session.close();
    EXPECT_EQ(session.next_action(), Action(SetBitRate{115200}));
    EXPECT_EQ(session.next_action(), std::nullopt);
}

TEST(Session, TheMotorSleepsForAllButNotUnderAStream) {
    Shell shell(prompt(), 2);
    ask(shell, "MD0002000301000", 0);
    EXPECT_EQ(ask(shell, "%SL", 1), "%SL\n10Q\n\n");
    ask(shell, "QT", 0);
    EXPECT_EQ(ask(shell, "%SL", 1), "%SL\n00P\n\n");
    EXPECT_EQ(ask(shell, "MD0002000301000", 0), "MD0002000301000\n10Q\n\n");
}

TEST(Session, AFailureEndsEveryStreamWithAMessage) {
    Shell shell(prompt(), 2);
    ask(shell, "MD0002000301000", 0);
    ask(shell, "ME0002000301000", 1);
    shell.device().set_trouble(Trouble::abnormal);
    shell.advance_to(100ms);
    EXPECT_EQ(shell.take_text(0), "MD0002000301000\n0Ll\n\n");
    EXPECT_EQ(shell.take_text(1), "ME0002000301000\n0Ll\n\n");
    EXPECT_FALSE(shell.device().laser_on());
}

TEST(Session, ItsEndIsAsClosing) {
    DeviceState device;
    const DeviceProfile profile = prompt();
    {
        Session session(profile, device);
        session.receive("BM\n", 0ms);
        EXPECT_TRUE(device.laser_on());
    }
    EXPECT_FALSE(device.laser_on());
}

}  // namespace
}  // namespace scipd::protocol
