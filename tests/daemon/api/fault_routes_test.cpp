// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The documents of faults and scenarios, literally, against faults that never act.
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/routes.h"
#include "daemon/faults/fault_kind.h"
#include "tests/support/fake_faults.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

const std::string path = "/sensors/rescue/front/faults";

class FaultyApi : public tests::EmptyApi {
  public:
    [[nodiscard]] std::optional<SensorLog> log(const std::string& sensor) const override {
        if (sensor == "rescue/front") return ScanLog{};
        return sensor == "rescue/sonar" ? std::optional<SensorLog>(StaringLog{}) : std::nullopt;
    }
    [[nodiscard]] FaultsApi& faults() override { return faults_; }

    tests::FakeFaults faults_;
};

class FaultRoutes : public testing::Test {
  protected:
    HttpResponse ask(const std::string& method, const std::string& where,
                     const std::string& body = {}, const std::string& query = {}) {
        std::optional<HttpResponse> answer;
        route(api_, {method, where, query, body},
              [&](const HttpResponse& response) { answer = response; });
        return answer.value();
    }
    /// The problem document of a refusal.
    json refused(int status, const HttpResponse& response) {
        EXPECT_EQ(response.status, status) << response.body;
        EXPECT_EQ(response.content_type, "application/problem+json");
        return json::parse(response.body);
    }
    json document(const std::string& where, const std::string& query = {}) {
        const auto response = ask("GET", where, {}, query);
        EXPECT_EQ(response.status, 200) << response.body;
        return json::parse(response.body);
    }
    void add_entries(int count) {
        for (int i = 0; i < count; ++i) {
            faults_.entries.add({.id = 3,
                                 .kind = "corrupt",
                                 .what = "1 byte of MD changed",
                                 .scan = 40 + i,
                                 .request = i == 0 ? "" : "MD0000108001000",
                                 .told = 1500ms,
                                 .bytes = {17},
                                 .steps = {}});
        }
    }

    FaultyApi api_;
    tests::FakeFaults& faults_ = api_.faults_;
};

TEST_F(FaultRoutes, AFaultIsAskedForListedAndTakenBack) {
    const auto asked = ask("POST", path, R"({"kind":"stall","for":{"s":2}})");
    EXPECT_EQ(asked.status, 201);
    EXPECT_EQ(asked.body, "{\"id\":1}\n");
    faults_.notes = {"it is late"};
    EXPECT_EQ(ask("POST", path, R"({"kind":"corrupt","bytes":{"rate":0.5}})").body,
              "{\"id\":2,\"notes\":[\"it is late\"]}\n");
    faults_.faults[2].state = "active";
    faults_.faults[2].hits = 7;
    faults_.faults[2].scenario_step = 4;
    EXPECT_EQ(document(path), json::parse(R"([
        {"id":1,"kind":"stall","state":"waiting","hits":0,"scenario_step":null,
         "fault":{"kind":"stall","for":{"s":2}}},
        {"id":2,"kind":"corrupt","state":"active","hits":7,"scenario_step":4,
         "fault":{"kind":"corrupt","bytes":{"rate":0.5}}}])"));
    EXPECT_EQ(document(path + "/2"), document(path)[1]);
    const auto stopped = ask("DELETE", path + "/1");
    EXPECT_EQ(stopped.status, 204);
    EXPECT_EQ(stopped.body, "");
    EXPECT_EQ(document(path).size(), 1U);
    EXPECT_EQ(ask("DELETE", path).status, 204);
    EXPECT_EQ(document(path), json::array());
}

TEST_F(FaultRoutes, AFaultThatIsNotThereIsNotFound) {
    (void)ask("POST", path, R"({"kind":"stall"})");
    for (const char* id : {"2", "0", "-1", "1x", "+1", "99999999999999999999999"}) {
        for (const char* method : {"GET", "DELETE"}) {
            EXPECT_THAT(refused(404, ask(method, path + "/" + id))["detail"],
                        HasSubstr("there is no fault \"" + std::string(id) + "\" at rescue/front"));
        }
    }
    EXPECT_EQ(document(path).size(), 1U);
}

TEST_F(FaultRoutes, AWrongFaultNamesItsField) {
    EXPECT_EQ(refused(400, ask("POST", path, R"({"kind":"dance"})"))["field"], "kind");
    EXPECT_THAT(refused(400, ask("POST", path, "{}"))["detail"], HasSubstr("kind"));
    EXPECT_THAT(refused(400, ask("POST", path, R"({"kind":"stall","for":3})"))["field"],
                StartsWith("for"));
    for (const char* body : {"", "[]", "{", "\xff", "3"})
        (void)refused(400, ask("POST", path, body));
    EXPECT_EQ(document(path), json::array());
}

TEST_F(FaultRoutes, OnlyScannersHaveFaults) {
    for (const char* method : {"GET", "POST", "DELETE"}) {
        for (const char* end : {"", "/1", "/log"}) {
            const auto of = [&](const std::string& sensor) {
                return ask(method, "/sensors/rescue/" + sensor + "/faults" + end,
                           R"({"kind":"stall"})");
            };
            if (of("front").status == 405) continue;
            EXPECT_EQ(refused(404, of("top"))["detail"], "there is no sensor \"rescue/top\"");
            EXPECT_THAT(refused(409, of("sonar"))["detail"], HasSubstr("speaks no SCIP"));
        }
    }
}

TEST_F(FaultRoutes, AThousandFaultsAreEnough) {
    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(ask("POST", path, R"({"kind":"stall"})").status, 201);
    EXPECT_THAT(refused(409, ask("POST", path, R"({"kind":"stall"})"))["detail"],
                StartsWith("1000 faults wait or act at rescue/front"));
    faults_.faults[500].state = "ended";
    EXPECT_EQ(ask("POST", path, R"({"kind":"stall"})").status, 201);
}

TEST_F(FaultRoutes, TheLogTellsWhatWasInjected) {
    EXPECT_EQ(document(path + "/log"), json::parse(R"({"entries":[],"first":0,"last":0})"));
    add_entries(2);
    EXPECT_EQ(document(path + "/log"), json::parse(R"({"entries":[
        {"n":1,"id":3,"kind":"corrupt","what":"1 byte of MD changed","scan":40,"request":null,
         "time_s":1.5,"bytes":[17],"steps":[]},
        {"n":2,"id":3,"kind":"corrupt","what":"1 byte of MD changed","scan":41,
         "request":"MD0000108001000","time_s":1.5,"bytes":[17],"steps":[]}],
        "first":1,"last":2})"));
}

TEST_F(FaultRoutes, TheLogCanBeReadOnFromANumber) {
    add_entries(5000);
    const json all = document(path + "/log");
    EXPECT_EQ(all["entries"].size(), FaultLog::capacity);
    EXPECT_EQ(all["first"], 5001 - FaultLog::capacity);
    const json later = document(path + "/log", "since=4997");
    EXPECT_EQ(later["entries"].size(), 3U);
    EXPECT_EQ(later["entries"][0]["n"], 4998);
    EXPECT_EQ(later["last"], 5000);
    EXPECT_EQ(document(path + "/log", "since=5000")["entries"], json::array());
    for (const char* query : {"since=", "since=-1", "since=x", "from=3"})
        EXPECT_EQ(refused(400, ask("GET", path + "/log", {}, query))["field"], "since");
}

TEST_F(FaultRoutes, TheLogIsNoFault) {
    EXPECT_EQ(ask("DELETE", path + "/log").status, 405);
    EXPECT_EQ(ask("DELETE", path + "/log").allow, "GET");
    EXPECT_EQ(ask("PUT", path + "/1").allow, "GET, DELETE");
}

TEST_F(FaultRoutes, AllKindsAreTold) {
    const json kinds = document("/faults/kinds");
    ASSERT_EQ(kinds.size(), fault_kinds().size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const FaultKind& kind = *fault_kinds()[i];
        EXPECT_EQ(kinds[i], json({{"kind", kind.name},
                                  {"layer", kind.layer},
                                  {"summary", kind.summary},
                                  {"members", kind.keys()},
                                  {"momentary", kind.momentary}}));
    }
}

std::string scenario_body(const std::string& yaml) {
    return json{{"name", "faults.yaml"}, {"yaml", yaml}}.dump();
}

TEST_F(FaultRoutes, AScenarioRunsUntilItIsStopped) {
    EXPECT_THAT(refused(404, ask("GET", "/scenario"))["detail"], HasSubstr("no scenario"));
    const auto run = ask("PUT", "/scenario",
                         scenario_body("steps:\n- {sensor: rescue/front, kind: stall}\n"
                                       "- {sensor: \"*\", kind: reboot}\n"));
    EXPECT_EQ(run.status, 200) << run.body;
    EXPECT_EQ(json::parse(run.body), json::parse(R"({"name":"faults.yaml","state":"running",
        "steps":[{"step":1,"sensor":"rescue/front","id":11,"kind":"stall","state":"active",
                  "hits":3},
                 {"step":2,"sensor":"rescue/front","id":12,"kind":"reboot","state":"active",
                  "hits":3}]})"));
    EXPECT_EQ(ask("GET", "/scenario").body, run.body);
    EXPECT_EQ(ask("DELETE", "/scenario").status, 204);
    EXPECT_EQ(document("/scenario")["state"], "ended");
}

TEST_F(FaultRoutes, AWrongScenarioTellsAllThatIsWrongAndDoesNotRun) {
    const auto problem =
        refused(400, ask("PUT", "/scenario",
                         scenario_body("steps:\n- {sensor: rescue/front, kind: dance}\n"
                                       "- {sensor: rescue/front, kind: stall}\n"
                                       "- {sensor: rescue/other, kind: stall}\n")));
    EXPECT_EQ(problem["field"], "yaml");
    ASSERT_EQ(problem["errors"].size(), 2U) << problem;
    EXPECT_THAT(problem["errors"][0], StartsWith("faults.yaml:2: steps"));
    EXPECT_THAT(problem["errors"][1], StartsWith("faults.yaml:4: steps"));
    EXPECT_FALSE(faults_.running);
}

TEST_F(FaultRoutes, AWrongRequestForAScenarioNamesItsField) {
    const std::pair<const char*, const char*> table[] = {
        {R"({"yaml":"steps: []"})", "name"},
        {R"({"name":"","yaml":"steps: []"})", "name"},
        {R"({"name":"a","yaml":3})", "yaml"},
        {R"({"name":"a"})", "yaml"},
        {R"({"name":"a","yaml":"","file":"b"})", "file"},
    };
    for (const auto& [body, field] : table)
        EXPECT_EQ(refused(400, ask("PUT", "/scenario", body))["field"], field) << body;
    for (const char* body : {"", "[]", "{", "\xff"})
        (void)refused(400, ask("PUT", "/scenario", body));
}

}  // namespace
}  // namespace scipd::daemon
