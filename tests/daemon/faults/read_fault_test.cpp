// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a fault means that somebody asks for, and the literal words for one that is wrong.
#include "daemon/faults/read_fault.h"

#include <chrono>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/daemon/faults/made_up_kinds.h"
#include "tests/support/why_not.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::made_up_kinds;
using Json = nlohmann::ordered_json;

sim::Expected<FaultPlan> parsed(const std::string& json) {
    return parse_fault(json, made_up_kinds());
}

/// {"kind": "nothing", ..}
FaultPlan with(const std::string& members) {
    auto plan = parsed(R"({"kind":"nothing",)" + members + "}");
    EXPECT_TRUE(plan) << members << ": " << (plan ? "" : plan.error().why);
    return plan.value_or(FaultPlan{});
}

/// "FIELD: sentence"
std::string fault_of(const std::string& json) {
    const auto plan = parsed(json);
    if (plan) return "none";
    const auto& [field, why] = plan.error();
    return field.empty() ? why : field + ": " + why;
}

void expect_same(const FaultPlan& a, const FaultPlan& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.start, b.start);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.every, b.every);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.said, b.said);
}

TEST(ReadFault, BeginsAtOnceAndLastsUnlessItSaysOtherwise) {
    const auto plan = parsed(R"({"kind":"nothing"})");
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->kind->name, "nothing");
    EXPECT_EQ(plan->start, FaultStart{AtOnce{}});
    EXPECT_EQ(plan->end, FaultEnd{UntilStopped{}});
    EXPECT_EQ(plan->every, FaultRepetition{});
    EXPECT_EQ(plan->seed, std::nullopt);
    EXPECT_TRUE(plan->make());
}

TEST(ReadFault, KnowsAllWaysToBegin) {
    EXPECT_EQ(with(R"("at":{"scan":200})").start, FaultStart{AtScan{200}});
    EXPECT_EQ(with(R"("at":{"scan":0})").start, FaultStart{AtScan{0}});
    EXPECT_EQ(with(R"("at":{"time_s":12.5})").start, FaultStart{AtTime{12500ms}});
    EXPECT_EQ(with(R"("at":{"scans":3})").start, FaultStart{AfterScans{3}});
    EXPECT_EQ(with(R"("at":{"s":0.25})").start, FaultStart{AfterTime{250ms}});
    EXPECT_EQ(with(R"("at":{"request":"MD"})").start, (FaultStart{AtRequest{"MD", 1}}));
    EXPECT_EQ(with(R"("at":{"request":"%TM1","nth":2})").start, (FaultStart{AtRequest{"%TM1", 2}}));
}

TEST(ReadFault, KnowsAllWaysToEndAndToComeAgain) {
    EXPECT_EQ(with(R"("for":{"scans":50})").end, FaultEnd{ForScans{50}});
    EXPECT_EQ(with(R"("for":{"s":3})").end, FaultEnd{ForTime{3s}});
    EXPECT_EQ(with(R"("until":"RB")").end, FaultEnd{UntilRequest{"RB"}});
    EXPECT_EQ(with(R"("every":{"s":30},"jitter":{"s":5})").every,
              (FaultRepetition{Every<sim::Time>{30s, 5s}}));
    EXPECT_EQ(with(R"("every":{"scans":7})").every, (FaultRepetition{Every<std::int64_t>{7, 0}}));
    EXPECT_EQ(with(R"("every":{"scans":7},"jitter":{"scans":3},"for":{"scans":2})").every,
              (FaultRepetition{Every<std::int64_t>{7, 3}}));
    EXPECT_EQ(with(R"("seed":18446744073709551615)").seed, 18446744073709551615U);
}

TEST(ReadFault, HandsTheMembersOfItsKindToTheEffect) {
    const auto plan =
        parsed(R"({"kind":"scratch","rate":0.25,"status":"0L","boot":true,"steps":[400,500]})");
    ASSERT_TRUE(plan);
    const auto effect = plan->make();
    const auto& said = dynamic_cast<const tests::Scratch&>(*effect).said;
    EXPECT_EQ(said.rate, 0.25);
    EXPECT_EQ(said.status, "0L");
    EXPECT_TRUE(said.boot);
    EXPECT_EQ(said.steps, (std::vector<double>{400.0, 500.0}));
    EXPECT_NE(plan->make(), effect);
}

TEST(ReadFault, SaysAgainWhatWasAsked) {
    for (const char* asked :
         {R"({"kind":"nothing"})",
          R"({"kind":"nothing","at":{"request":"MD","nth":2},"until":"RB","seed":7})",
          R"({"kind":"nothing","at":{"time_s":0.1},"for":{"s":1e-3}})",
          R"({"kind":"nothing","every":{"s":30},"jitter":{"s":0.1},"seed":18446744073709551615})",
          R"({"kind":"scratch","rate":1,"status":"00","boot":false,"steps":[1,2.5]})",
          R"({"kind":"scratch","rate":0.1,"status":"10"})"}) {
        const auto plan = parsed(asked);
        ASSERT_TRUE(plan) << asked << ": " << plan.error().why;
        EXPECT_EQ(Json::parse(plan->said), Json::parse(asked));
        const auto again = parsed(plan->said);
        ASSERT_TRUE(again) << plan->said;
        expect_same(*plan, *again);
    }
}

TEST(ReadFault, SaysInOneSentenceWhatIsWrong) {
    const std::string number = "must be a whole number from ";
    const std::string command = "must be the code of a command, such as MD, GD, QT or RB, not ";
    const std::pair<const char*, std::string> table[] = {
        {R"("at":3)",
         "at: must be a map of keys and values; known here are nth, scan, time_s, scans, s, "
         "request"},
        {R"("at":{})", "at: needs one of scan, time_s, scans, s, request"},
        {R"("at":{"scan":1,"s":1})", "at: must have only one of scan, time_s, scans, s, request"},
        {R"("at":{"scan":-1})", "at.scan: " + number + "0 to 999999999, not '-1'"},
        {R"("at":{"scan":1.5})", "at.scan: " + number + "0 to 999999999, not '1.5'"},
        {R"("at":{"scans":1000000000})",
         "at.scans: " + number + "0 to 999999999, not '1000000000'"},
        {R"("at":{"time_s":-1})", "at.time_s: must be a time from 0 to 9e9 s, not '-1'"},
        {R"("at":{"time_s":"soon"})", "at.time_s: must be a time from 0 to 9e9 s, not 'soon'"},
        {R"("at":{"s":1000001})", "at.s: must be 0 to 1000000 s, not '1000001'"},
        {R"("at":{"s":null})", "at.s: has no value; give one or leave the key out"},
        {R"("at":{"secs":3})",
         "at.secs: unknown key; known here are nth, scan, time_s, scans, s, request"},
        {R"("at":{"request":"XX"})", "at.request: " + command + "'XX'"},
        {R"("at":{"request":"md"})", "at.request: " + command + "'md'"},
        {R"("at":{"request":"MD","nth":0})", "at.nth: " + number + "1 to 1000000, not '0'"},
        {R"("at":{"request":"MD","nth":1000001})",
         "at.nth: " + number + "1 to 1000000, not '1000001'"},
        {R"("at":{"scan":1,"nth":2})", "at.nth: is of request; leave it out"},
        {R"("for":{})", "for: needs one of scans, s"},
        {R"("for":{"scans":1,"s":1})", "for: must have only one of scans, s"},
        {R"("for":{"scans":0})", "for.scans: " + number + "1 to 999999999, not '0'"},
        {R"("for":{"s":0})", "for.s: must be at least 0.001 s, not '0'"},
        {R"("for":{"s":"1 s"})", "for.s: must be a number, not '1 s'"},
        {R"("until":"")", "until: " + command + "''"},
        {R"("until":{"request":"RB"})", "until: must be a single value, not a map"},
        {R"("for":{"s":1},"until":"RB")", "until: cannot stand beside for; leave one of them out"},
        {R"("at":{"s":1},"every":{"s":1})", "at: cannot stand beside every; leave one of them out"},
        {R"("every":{"s":0.0001})", "every.s: must be at least 0.001 s, not '0.0001'"},
        {R"("jitter":{"s":1})", "jitter: needs every, which it varies"},
        {R"("every":{"s":1},"jitter":{"scans":1})", "jitter: must be of the same unit as every"},
        {R"("every":{"s":1},"jitter":{"s":0.5})", "jitter: must be less than half of every"},
        {R"("every":{"s":1},"jitter":{"s":-1})", "jitter.s: must be 0 to 1000000 s, not '-1'"},
        {R"("seed":-1)", "seed: " + number + "0 to 18446744073709551615, not '-1'"},
        {R"("rate":1)",
         "rate: unknown key; known here are kind, at, for, until, every, jitter, seed"},
        {R"("att":{})", "att: unknown key; did you mean at?"},
    };
    for (const auto& [members, sentence] : table)
        EXPECT_EQ(fault_of(R"({"kind":"nothing",)" + std::string(members) + "}"), sentence);
}

TEST(ReadFault, NeedsAKindThatThereIs) {
    EXPECT_EQ(fault_of("{}"), "needs a kind: one of nothing, scratch");
    EXPECT_EQ(fault_of(R"({"kind":["nothing"]})"), "kind: must be a single value, not a list");
    EXPECT_EQ(fault_of(R"({"kind":"fire"})"),
              "kind: there is no kind 'fire'; there are nothing, scratch");
    EXPECT_EQ(fault_of(R"({"kind":"scrtach","rate":1})"),
              "kind: there is no kind 'scrtach'; did you mean scratch? There are nothing, scratch");
    EXPECT_EQ(fault_of(R"({"kind":"scratch"})"), "needs rate, 0 to 1");
    EXPECT_EQ(fault_of(R"({"kind":"scratch","rate":2})"), "rate: must be 0 to 1, not '2'");
    EXPECT_EQ(fault_of(R"({"kind":"nothing","sensor":"a/b"})"),
              "sensor: unknown key; known here are kind, at, for, until, every, jitter, seed");
}

TEST(ReadFault, TakesOnlyOneSmallJsonObject) {
    EXPECT_EQ(fault_of("[]"), R"(must be a JSON object such as {"kind":"reboot"})");
    EXPECT_EQ(fault_of(R"({"kind":"nothing","at":{"scan":1}} {})").substr(0, 33),
              "must be a JSON object: not JSON: ");
    EXPECT_EQ(fault_of("kind: nothing").substr(0, 33), "must be a JSON object: not JSON: ");
    EXPECT_EQ(fault_of(R"({"kind":[[[[[[[[[[0]]]]]]]]]]})"),
              "must be a JSON object: nests deeper than 8 levels");
    std::string many = R"({"kind":"scratch","rate":1,"steps":[1)";
    for (int i = 0; i < 300; ++i)
        many += ",1";
    EXPECT_EQ(fault_of(many + "]}"), "must be a JSON object: has more than 256 keys and values");
    const std::string blanks((16 << 10) - 18, ' ');
    EXPECT_EQ(fault_of(R"({"kind":"nothing"})" + blanks), "none");
    EXPECT_EQ(fault_of(R"({"kind":"nothing"})" + blanks + " "), "must be at most 16 KiB");
    // More faults than anybody would read.
    std::string wrong = R"({"kind":"nothing")";
    for (int i = 0; i < 120; ++i)
        wrong += ",\"wrong" + std::to_string(i) + "\":1";
    EXPECT_EQ(fault_of(wrong + "}").substr(0, 20), "wrong0: unknown key;");
}

TEST(ReadFault, ReadsAnyTextThatJsonCanHold) {
    for (const char* status : {R"("0L")", R"("a\"b\\c\/d")", R"("\u00e9\ud83d\ude00")",
                               R"("* & ! : - [")", R"("\t\n\u0001")", R"("~")"}) {
        const auto plan =
            parsed(R"({"kind":"scratch","rate":1,"status":)" + std::string(status) + "}");
        ASSERT_TRUE(plan) << status << plan.error().why;
        const auto effect = plan->make();
        EXPECT_EQ(dynamic_cast<const tests::Scratch&>(*effect).said.status,
                  Json::parse(status).get<std::string>());
        EXPECT_EQ(Json::parse(plan->said)["status"], Json::parse(status));
    }
}

TEST(ReadFault, RefusesAKeyThatStandsTwice) {
    const auto refused = parse_fault(R"({"kind":"stall","for":{"s":1},"kind":"freeze"})");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "kind");
    EXPECT_EQ(refused.error().why, "is given twice");
    EXPECT_EQ(parse_fault(R"({"kind":"stall","for":{"s":1,"s":2}})").error().field, "s");
    EXPECT_TRUE(parse_fault(R"({"kind":"stall","at":{"s":1},"for":{"s":2}})"));
}

TEST(ReadFault, RefusesToRepeatWhatDoesNotEnd) {
    const auto refused = parse_fault(R"({"kind":"stall","every":{"s":5}})");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "every");
    EXPECT_EQ(refused.error().why, "needs for or until: what does not end does not begin again");
    EXPECT_TRUE(parse_fault(R"({"kind":"stall","every":{"s":5},"for":{"s":1}})"));
    EXPECT_TRUE(parse_fault(R"({"kind":"reboot","every":{"s":5}})"));
}

}  // namespace
}  // namespace scipd::daemon
