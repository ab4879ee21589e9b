// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl fault and scipctl scenario against the real routes.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipctl/control_stand_in.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

const std::string front = "rescue/front";

class ScipctlFault : public testing::Test {
  protected:
    Outcome scipctl(std::vector<std::string> words) const {
        words.insert(words.begin(), {SCIPCTL, "--control", daemon_.socket()});
        return run(words);
    }
    std::string done(const std::vector<std::string>& words) const {
        const Outcome outcome = scipctl(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    }
    std::string refused(int exit_code, const std::vector<std::string>& words) const {
        const Outcome outcome = scipctl(words);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        return outcome.err;
    }
    json list() const { return json::parse(done({"fault", "list", "--json"})); }
    /// What the daemon is asked for by these words.
    json asked_for(std::vector<std::string> words) const {
        words.insert(words.begin(), {"fault", "start", front});
        (void)done(words);
        const json faults = list();
        return faults.empty() ? json() : faults.back()["fault"];
    }
    void log(int count) {
        for (int i = 0; i < count; ++i) {
            daemon_.log_fault({.id = 2,
                               .kind = "corrupt",
                               .what = "1 byte changed",
                               .scan = 7,
                               .request = "MD0000108001000",
                               .told = 1250ms,
                               .bytes = {5},
                               .steps = {}});
        }
    }

    ControlStandIn daemon_{{"rescue"}};
};

TEST_F(ScipctlFault, StartsListsAndStops) {
    EXPECT_EQ(done({"fault", "list"}), "no faults are pending or active\n");
    EXPECT_EQ(done({"fault", "start", front, "stall", "--for", "s=2"}), "1\n");
    EXPECT_EQ(done({"fault", "start", front, "reboot"}), "2\n");
    EXPECT_EQ(done({"fault", "list", front}),
              "SENSOR        ID  KIND    STATE    HITS  STEP  HOW\n"
              "rescue/front  1   stall   waiting  0     -     {\"for\":{\"s\":2}}\n"
              "rescue/front  2   reboot  waiting  0     -     -\n");
    EXPECT_EQ(list()[0]["sensor"], front);
    EXPECT_EQ(list(), json::parse(done({"fault", "list", front, "--json"})));
    EXPECT_EQ(done({"fault", "stop", front, "1"}), "");
    EXPECT_EQ(list().size(), 1U);
    EXPECT_EQ(done({"fault", "stop", front}), "");
    EXPECT_EQ(list().size(), 0U);
    (void)done({"fault", "start", front, "stall"});
    EXPECT_EQ(done({"fault", "stop", front, "all"}), "");
    EXPECT_EQ(list().size(), 0U);
}

TEST_F(ScipctlFault, NeedsNoNameWhereThereIsOneScanner) {
    EXPECT_EQ(done({"fault", "start", "stall", "--for", "s=2"}), "1\n");
    EXPECT_EQ(done({"fault", "start", "corrupt", "bytes.rate=0.01", "messages=scans"}), "2\n");
    EXPECT_EQ(done({"fault", "start", "--json", R"({"kind":"stall"})"}), "3\n");
    EXPECT_EQ(list()[1]["fault"],
              json::parse(R"({"kind":"corrupt","bytes":{"rate":0.01},"messages":"scans"})"));
    EXPECT_EQ(done({"fault", "stop", "1"}), "");
    EXPECT_EQ(list().size(), 2U);
    EXPECT_EQ(done({"fault", "stop"}), "");
    EXPECT_EQ(list().size(), 0U);
    log(1);
    EXPECT_THAT(done({"fault", "log", "--count", "1"}), HasSubstr("corrupt"));
}

TEST(ScipctlFaults, NeedANameWhereThereAreSeveralScanners) {
    const ControlStandIn daemon({"left", "right"});
    const Outcome outcome = run({SCIPCTL, "--control", daemon.socket(), "fault", "start", "stall"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "scipctl: which scanner? Name one of left/front, right/front\n");
}

TEST_F(ScipctlFault, ReadsMembersAsYaml) {
    const json rate = json::parse(R"({"kind":"corrupt","bytes":{"rate":0.01},"messages":"scans"})");
    EXPECT_EQ(asked_for({"corrupt", "bytes.rate=0.01", "messages=scans"}), rate);
    EXPECT_EQ(asked_for({"corrupt", "bytes={rate: 0.01}", "messages=\"scans\""}), rate);
    EXPECT_EQ(asked_for({"corrupt", "bytes={\"rate\":0.01}", "messages='scans'"}), rate);
    EXPECT_EQ(asked_for({"--json", rate.dump()}), rate);
    EXPECT_EQ(asked_for({"corrupt", "bytes.at=[400,500]"})["bytes"]["at"], json::array({400, 500}));
}

TEST_F(ScipctlFault, ReadsWhenAndForHowLong) {
    EXPECT_EQ(asked_for({"stall", "--at", "scan=120", "--until", "RB", "--seed", "7"}),
              json::parse(R"({"kind":"stall","at":{"scan":120},"until":"RB","seed":7})"));
    EXPECT_EQ(asked_for({"stall", "--at", "request=MD:2", "--for", "scans=10"}),
              json::parse(R"({"kind":"stall","at":{"request":"MD","nth":2},"for":{"scans":10}})"));
    EXPECT_EQ(asked_for({"stall", "--at", "request=BM"})["at"], json::parse(R"({"request":"BM"})"));
    EXPECT_EQ(asked_for({"stall", "--for", "s=1", "--every", "s=10", "--jitter", "s=2.5"}),
              json::parse(R"({"kind":"stall","for":{"s":1},"every":{"s":10},"jitter":{"s":2.5}})"));
}

TEST_F(ScipctlFault, SaysWhatIsWrong) {
    EXPECT_EQ(refused(1, {"fault", "start", "rescue/top", "stall"}),
              "scipctl: there is no sensor \"rescue/top\"; there are: rescue/front\n");
    for (const char* command : {"stop", "list", "log"}) {
        EXPECT_THAT(refused(1, {"fault", command, "rescue/top"}),
                    HasSubstr("there are: rescue/front"));
    }
    EXPECT_THAT(refused(1, {"fault", "start", front, "dance"}),
                StartsWith("scipctl: there is no kind 'dance'; "));
    EXPECT_THAT(refused(1, {"fault", "stop", front, "9"}), HasSubstr("there is no fault \"9\""));
    EXPECT_EQ(refused(2, {"fault", "start", front}),
              "scipctl: name a kind of fault; `scipctl fault kinds` lists them\n");
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "ms"}),
                HasSubstr("\"ms\" is no KEY=VALUE"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "--at", "12"}),
                HasSubstr("\"12\" is no KEY=VALUE, such as scan=120"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "ms=[1"}), HasSubstr("is no value"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "ms=1", "ms.x=1"}),
                HasSubstr("goes into what is no map"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "ms=1", "ms=2"}),
                HasSubstr("a second time"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "--json", "{"}), HasSubstr("--json must be"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "stall", "--json", "{}"}),
                HasSubstr("leave out"));
    EXPECT_THAT(refused(2, {"fault", "start", front, "--json", "{}", "--for", "s=1"}),
                HasSubstr("leave out"));
    EXPECT_EQ(list(), json::array());
}

TEST_F(ScipctlFault, TellsTheLog) {
    log(3);
    const std::string all = done({"fault", "log", front});
    EXPECT_THAT(all, StartsWith("    1       1.250 s  scan 7       fault 2 corrupt: 1 byte changed"
                                "  (MD0000108001000)\n"));
    EXPECT_EQ(std::ranges::count(all, '\n'), 3);
    const std::string last = done({"fault", "log", front, "--since", "2", "--json"});
    EXPECT_EQ(json::parse(last)["n"], 3);
    EXPECT_EQ(json::parse(last)["bytes"], json::array({5}));
    EXPECT_EQ(std::ranges::count(last, '\n'), 1);
}

TEST_F(ScipctlFault, FollowsTheLogForAsManyEntriesAsAsked) {
    log(2);
    std::thread later([this] {
        std::this_thread::sleep_for(300ms);
        log(5);
    });
    const std::string told = done({"fault", "log", front, "--follow", "--count", "4", "--json"});
    later.join();
    EXPECT_EQ(std::ranges::count(told, '\n'), 4);
    EXPECT_EQ(json::parse(told.substr(told.rfind('{', told.size() - 3)))["n"], 4);
}

TEST_F(ScipctlFault, ListsTheKinds) {
    const json kinds = json::parse(done({"fault", "kinds", "--json"}));
    std::string names;
    for (const json& kind : kinds)
        names += kind["kind"].get<std::string>() + "\n";
    EXPECT_EQ(done({"fault", "kinds", "--names"}), names);
    EXPECT_THAT(done({"fault", "kinds"}), StartsWith("KIND"));
}

TEST_F(ScipctlFault, RunsAScenario) {
    const TempDir folder;
    const std::string file = folder.path() / "faults.yaml";
    std::ofstream(file) << "steps:\n- {sensor: rescue/front, kind: stall}\n";
    EXPECT_THAT(refused(1, {"scenario", "status"}), HasSubstr("no scenario was run"));
    EXPECT_EQ(done({"scenario", "run", file}), "");
    EXPECT_EQ(done({"scenario", "status"}),
              "faults.yaml: running\n\n"
              "STEP  SENSOR        ID  KIND   STATE   HITS\n"
              "1     rescue/front  11  stall  active  3\n");
    EXPECT_EQ(done({"scenario", "stop"}), "");
    EXPECT_EQ(json::parse(done({"scenario", "status", "--json"}))["state"], "ended");
}

TEST_F(ScipctlFault, TellsAllThatIsWrongWithAScenario) {
    const TempDir folder;
    const std::string file = folder.path() / "faults.yaml";
    std::ofstream(file) << "steps:\n- {sensor: rescue/front, kind: dance}\n"
                           "- {sensor: rescue/top, kind: stall}\n";
    const std::string said = refused(1, {"scenario", "run", file});
    EXPECT_THAT(said, HasSubstr("\nfaults.yaml:2: steps"));
    EXPECT_THAT(said, HasSubstr("\nfaults.yaml:3: steps"));
    EXPECT_THAT(refused(2, {"scenario", "run", "/dev/zero"}), HasSubstr("too long"));
    EXPECT_THAT(refused(2, {"scenario", "run", "no/such/file"}), HasSubstr("no/such/file"));
}

TEST(ScipctlFaultCompletion, KnowsTheKindsOfTheDaemon) {
    const std::string kinds = "scipctl() { test \"$*\" = 'fault kinds --names' && echo st cut; };";
    const std::string bash =
        run({"/usr/bin/env", "bash", "-c",
             kinds + "source <(" SCIPCTL " completion bash); COMP_WORDS=(scipctl fault start x c)"
                     "; COMP_CWORD=4; _scipctl; echo \"${COMPREPLY[@]}\""})
            .out;
    EXPECT_EQ(bash, "cut\n");
    const std::string zsh =
        run({"/usr/bin/env", "zsh", "-fc",
             kinds +
                 "compdef() {}; _files() {}; compadd() { print -r -- \"$@\" }; source <(" SCIPCTL
                 " completion zsh); words=(scipctl fault start x ''); CURRENT=5; _scipctl"})
            .out;
    EXPECT_THAT(zsh, StartsWith("-- st cut --help --at --for"));
}

}  // namespace
}  // namespace scipd::tests
