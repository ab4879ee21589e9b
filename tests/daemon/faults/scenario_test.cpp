// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scenario means, and the literal words of every fault in a broken one.
#include "daemon/faults/scenario.h"

#include <array>
#include <chrono>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"
#include "tests/daemon/faults/made_up_kinds.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using tests::made_up_kinds;

const std::vector<std::string> scanners{"rescue/front", "rescue/rear"};

Scenario parse(const std::string& text) {
    return parse_scenario(text, "bad_day.yaml", scanners, made_up_kinds());
}

std::vector<std::string> faults(const std::string& text) {
    try {
        parse(text);
    } catch (const sim::LoadError& error) {
        return error.faults();
    }
    return {};
}

std::vector<std::string> faults_of_file(const std::filesystem::path& file) {
    try {
        load_scenario(file, scanners, made_up_kinds());
    } catch (const sim::LoadError& error) {
        return error.faults();
    }
    return {};
}

constexpr const char* whole = R"(seed: 7
steps:
  - {at: {scan: 200}, sensor: rescue/front, kind: scratch, rate: 0.01, for: {scans: 50}}
  - {at: {time_s: 12.5}, sensor: rescue/rear, kind: scratch, rate: 1, steps: [4, 5], for: {s: 3}}
  - at: {request: MD, nth: 2}
    sensor: "rescue/front"
    kind: scratch
    rate: 1
    status: 0L
    until: RB
  - {every: {s: 30}, jitter: {s: 5}, sensor: "*", kind: nothing, seed: 3}
)";

TEST(Scenario, HoldsWhatTheFileSays) {
    const Scenario scenario = parse(whole);
    EXPECT_EQ(scenario.name, "bad_day.yaml");
    EXPECT_EQ(scenario.seed, 7U);
    ASSERT_EQ(scenario.steps.size(), 4U);
    EXPECT_EQ(scenario.steps[0].sensor, "rescue/front");
    EXPECT_EQ(scenario.steps[0].fault.start, FaultStart{AtScan{200}});
    EXPECT_EQ(scenario.steps[0].fault.end, FaultEnd{ForScans{50}});
    EXPECT_EQ(scenario.steps[1].fault.start, FaultStart{AtTime{12500ms}});
    EXPECT_EQ(scenario.steps[1].fault.said,
              R"({"at":{"time_s":12.5},"kind":"scratch","rate":1,"steps":[4,5],"for":{"s":3}})");
    EXPECT_EQ(
        scenario.steps[2].fault.said,
        R"({"at":{"request":"MD","nth":2},"kind":"scratch","rate":1,"status":"0L","until":"RB"})");
    EXPECT_EQ(scenario.steps[3].sensor, "*");
    EXPECT_EQ(scenario.steps[3].fault.seed, 3U);
    EXPECT_EQ(parse("steps: [{sensor: '*', kind: nothing}]").seed, 1U);
}

TEST(Scenario, GoesByTheControlApiAsWell) {
    for (const ScenarioStep& step : parse(whole).steps) {
        const auto plan = parse_fault(step.fault.said, made_up_kinds());
        ASSERT_TRUE(plan) << step.fault.said;
        EXPECT_EQ(plan->kind, step.fault.kind);
        EXPECT_EQ(plan->start, step.fault.start);
        EXPECT_EQ(plan->end, step.fault.end);
        EXPECT_EQ(plan->every, step.fault.every);
        EXPECT_EQ(plan->seed, step.fault.seed);
        EXPECT_EQ(plan->said, step.fault.said);
    }
}

TEST(Scenario, IsTheSameWhereItAsksForTheSame) {
    const std::string one = "steps: [{sensor: rescue/front, kind: nothing, for: {s: 1}}]";
    EXPECT_EQ(parse(one),
              parse("# bad\nsteps:\n- {sensor: rescue/front, kind: nothing, for: {s: 1}}"));
    EXPECT_NE(parse(one), parse("seed: 2\n" + one));
    EXPECT_NE(parse(one), parse("steps: [{sensor: rescue/rear, kind: nothing, for: {s: 1}}]"));
    EXPECT_NE(parse(one), parse("steps: [{sensor: rescue/front, kind: nothing, for: {s: 2}}]"));
    EXPECT_FALSE(parse(one) == parse_scenario(one, "other.yaml", scanners, made_up_kinds()));
}

TEST(Scenario, TellsAllFaultsAtOnceEachWithItsLine) {
    EXPECT_THAT(faults(R"(seed: x
step: []
steps:
  - {sensor: rescue/fornt, kind: nothing}
  - kind: nohting
    at: {scan: -1}
    sensor: "*"
  - {kind: scratch}
  - 3
  - sensor: "*"
    kind: nothing
    for: {s: 1}
    until: RB
    bytes: 3
    kind: scratch
)"),
                ElementsAre("bad_day.yaml:1: seed: must be a whole number from 0 to "
                            "18446744073709551615, not 'x'",
                            "bad_day.yaml:2: step: unknown key; did you mean steps?",
                            "bad_day.yaml:4: steps.1.sensor: there is no scanner 'rescue/fornt'; "
                            "there are \"*\" for every one, rescue/front, rescue/rear",
                            "bad_day.yaml:5: steps.2.kind: there is no kind 'nohting'; did you "
                            "mean nothing? There are nothing, scratch",
                            "bad_day.yaml:6: steps.2.at.scan: must be a whole number from 0 to "
                            "999999999, not '-1'",
                            "bad_day.yaml:8: steps.3: needs a sensor: ROBOT/SENSOR, or \"*\" for "
                            "every scanner",
                            "bad_day.yaml:8: steps.3: needs rate, 0 to 1",
                            "bad_day.yaml:9: steps.4: must be a map of keys and values, such as "
                            "{kind: stall, for: {s: 2}}",
                            "bad_day.yaml:13: steps.5.until: cannot stand beside for; leave one of "
                            "them out",
                            "bad_day.yaml:14: steps.5.bytes: unknown key; known here are kind, at, "
                            "for, until, every, jitter, seed, sensor",
                            "bad_day.yaml:15: steps.5.kind: given twice, first in line 11; keep "
                            "one"));
}

TEST(Scenario, NeedsSteps) {
    const std::string list = "bad_day.yaml:1: steps: must be a list of 1 to 1000 steps";
    EXPECT_THAT(faults(""), ElementsAre("bad_day.yaml:1: needs steps, a list of faults"));
    EXPECT_THAT(faults("[]"),
                ElementsAre("bad_day.yaml:1: must be a map of keys and values; known here are "
                            "seed, steps"));
    EXPECT_THAT(faults("steps: []"), ElementsAre(list));
    EXPECT_THAT(faults("steps: {kind: nothing}"), ElementsAre(list));
    EXPECT_THAT(faults("steps: ~"), ElementsAre(list));
    const std::string step = "- {sensor: '*', kind: nothing}\n";
    std::string steps = "steps:\n";
    for (int i = 0; i < 1000; ++i)
        steps += step;
    EXPECT_EQ(parse(steps).steps.size(), 1000U);
    EXPECT_THAT(faults(steps + step), ElementsAre(list));
}

TEST(Scenario, IsOneYamlDocumentOfAtMostOneMebibyte) {
    EXPECT_THAT(faults("steps: [{"),
                ElementsAre(testing::StartsWith("bad_day.yaml:1: not YAML: ")));
    EXPECT_THAT(
        faults("steps:\n- {sensor: *, kind: nothing}"),
        ElementsAre("bad_day.yaml:2: not YAML: alias not found after *; a star by itself needs "
                    "quotes: \"*\""));
    EXPECT_THAT(faults(std::string(whole) + "---\n{}\n"),
                ElementsAre("bad_day.yaml:12: a second YAML document; keep one"));
    const std::string step = "steps: [{sensor: '*', kind: nothing}]\n#";
    const std::string comment((1 << 20) - step.size(), '#');
    EXPECT_EQ(parse(step + comment).steps.size(), 1U);
    EXPECT_THAT(faults(step + comment + "#"),
                ElementsAre("bad_day.yaml:1: larger than 1 MiB; split it"));
}

TEST(Scenario, MayShareWhatStepsHaveInCommon) {
    const Scenario scenario = parse(
        "steps:\n- {sensor: '*', kind: nothing, for: &while {s: 3}}\n"
        "- {sensor: '*', kind: nothing, for: *while}\n");
    ASSERT_EQ(scenario.steps.size(), 2U);
    EXPECT_EQ(scenario.steps[1].fault.end, FaultEnd{ForTime{3s}});
    EXPECT_EQ(scenario.steps[1].fault.said, R"({"kind":"nothing","for":{"s":3}})");
    EXPECT_THAT(
        faults("steps: &all\n- *all\n"),
        ElementsAre(testing::HasSubstr("must be a map of keys and values, such as {kind: ")));
    EXPECT_THAT(faults("steps:\n- &step {sensor: '*', kind: nothing, at: *step}\n"),
                testing::Contains(testing::HasSubstr("steps.1.at.at: unknown key")));
}

TEST(Scenario, KnowsOnlyScannersThatThereAre) {
    try {
        parse_scenario("steps: [{sensor: a/b, kind: nothing}]", "s.yaml",
                       std::vector<std::string>{}, made_up_kinds());
        FAIL();
    } catch (const sim::LoadError& error) {
        EXPECT_THAT(error.faults(), ElementsAre("s.yaml:1: steps.1.sensor: there is no scanner "
                                                "'a/b', nor any other"));
    }
}

TEST(Scenario, IsAFile) {
    const tests::TempDir dir;
    const auto file = dir.write("bad_day.yaml", whole);
    const Scenario scenario = load_scenario(file, scanners, made_up_kinds());
    EXPECT_EQ(scenario.name, file.string());
    EXPECT_EQ(scenario.steps.size(), 4U);
    const auto wrong = dir.write("wrong.yaml", "\nsteps: 3\n");
    EXPECT_THAT(faults_of_file(wrong),
                ElementsAre(wrong.string() + ":2: steps: must be a list of 1 to 1000 steps"));
    const std::string wanted = "; name a scenario of at most 1 MiB";
    const auto missing = dir.path() / "missing.yaml";
    EXPECT_THAT(faults_of_file(missing), ElementsAre(missing.string() + ": no such file" + wanted));
    EXPECT_THAT(faults_of_file(dir.path()),
                ElementsAre(dir.path().string() + ": is a directory" + wanted));
    const auto large = dir.write("large.yaml", std::string((1 << 20) + 1, '#'));
    EXPECT_THAT(faults_of_file(large), ElementsAre(testing::EndsWith(wanted)));
}

/// The text with a few letters changed, lost, or brought from elsewhere in it.
std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t limit) { return random() % limit; };
    for (std::size_t n = 1 + below(3); n > 0 && text.size() > 40; --n) {
        const std::size_t at = below(text.size() - 20);
        switch (below(8)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text.erase(at, 1 + below(20));
                break;
            case 2:
                text.insert(at, text.substr(below(text.size() - 20), 1 + below(20)));
                break;
            case 3:
                text[at] = "*&!{}[]:,-#'\"\n 09~"[below(18)];
                break;
            default:
                if (const auto digit = text.find_first_of("0123456789", at); digit != text.npos)
                    text[digit] = static_cast<char>('0' + below(10));
        }
    }
    return text;
}

TEST(Scenario, IsReadOrRefusedWhateverItSays) {
    std::mt19937 random{15};
    int read = 0;
    constexpr int rounds = 1000;
    for (int i = 0; i < rounds; ++i) {
        const std::string text = mutated(whole, random);
        try {
            for (const ScenarioStep& step : parse(text).steps)
                EXPECT_TRUE(parse_fault(step.fault.said, made_up_kinds())) << step.fault.said;
            ++read;
        } catch (const sim::LoadError& error) {
            ASSERT_FALSE(error.faults().empty());
            for (const std::string& fault : error.faults())
                ASSERT_TRUE(fault.starts_with("bad_day.yaml:")) << fault << text;
        }
    }
    // Neither all nor none, or the test would say nothing.
    EXPECT_GT(read, rounds / 20);
    EXPECT_LT(read, rounds * 19 / 20);
}

/// With every key that a step of the kind can have, but nothing in the values that makes sense.
std::string nonsense_of(const FaultKind& kind, std::mt19937& random) {
    constexpr std::array values{"1",          "0.5",         "-1",        "true",
                                "[400, 500]", "{rate: 0.1}", "{at: []}",  "{request: MD}",
                                "0L",         "~",           "[{}, [~]]", "{s: 1}",
                                "{every: 3}"};
    std::string step = "{sensor: '*', kind: " + std::string(kind.name);
    std::vector<std::string_view> keys = kind.keys();
    keys.insert(keys.end(), {"at", "for"});
    for (const std::string_view key : keys) {
        if (random() % 2 != 0)
            step += ", " + std::string(key) + ": " + values[random() % values.size()];
    }
    return step + "}";
}

TEST(Scenario, SurvivesNonsenseForEachKind) {
    std::mt19937 random{15};
    for (const FaultKind* const kind : fault_kinds()) {
        for (int i = 0; i < 200; ++i) {
            const std::string step = nonsense_of(*kind, random);
            try {
                const auto scenario =
                    parse_scenario("steps: [" + step + "]", "nonsense.yaml", scanners);
                const auto& fault = scenario.steps.at(0).fault;
                EXPECT_TRUE(parse_fault(fault.said)) << step;
                EXPECT_TRUE(fault.make()) << step;
            } catch (const sim::LoadError& error) {
                EXPECT_FALSE(error.faults().empty());
            } catch (const std::exception& error) {
                ADD_FAILURE() << step << ": " << error.what();
            }
        }
    }
}

}  // namespace
}  // namespace scipd::daemon
