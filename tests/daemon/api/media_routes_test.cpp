// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The media of a world, as the control API takes and tells them.
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/routes.h"
#include "tests/support/empty_api.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

class NotingApi : public tests::EmptyApi {
  public:
    std::vector<std::string> set_media(std::vector<sim::Medium> media) override {
        (void)EmptyApi::set_media(std::move(media));
        return notes_;
    }
    std::vector<std::string> notes_;
};

class MediaRoutes : public testing::Test {
  protected:
    HttpResponse ask(const std::string& method, const std::string& body = {}) {
        std::optional<HttpResponse> answer;
        route(api_, {method, "/scene/media", "", body},
              [&](const HttpResponse& response) { answer = response; });
        return answer.value();
    }

    /// The field at fault and the sentence of a refusal.
    std::string refusal(const std::string& body) {
        const HttpResponse response = ask("PUT", body);
        EXPECT_EQ(response.status, 400) << body;
        EXPECT_EQ(response.content_type, "application/problem+json");
        const json document = json::parse(response.body);
        return document.value("field", "-") + ": " + document["detail"].get<std::string>();
    }

    NotingApi api_;
};

TEST_F(MediaRoutes, TellWhatTheyTook) {
    EXPECT_EQ(ask("GET").body, "[]\n");
    const std::string list =
        R"([{"kind":"fog","name":"mist","visibility_m":20.0,)"
        R"("box":{"from":[0.0,-1.5,0.0],"to":[3.0,2.0,2.5]}},)"
        R"({"kind":"rain","name":"rain","mm_per_hour":10.0},)"
        R"({"kind":"custom","name":"steam","extinction_per_m":0.5,"returns_per_m":2.0,)"
        R"("brightness":0.25}])";
    const HttpResponse put = ask("PUT", list);
    EXPECT_EQ(put.status, 200) << put.body;
    EXPECT_EQ(put.body, "{\"warnings\":[]}\n");
    EXPECT_EQ(ask("GET").body, list + "\n");
    sim::Medium mist = sim::fog(20.0);
    mist.name = "mist";
    mist.low_m = {0.0, -1.5, 0.0};
    mist.high_m = {3.0, 2.0, 2.5};
    const sim::Medium steam{
        .name = "steam", .extinction_per_m = 0.5, .returns_per_m = 2.0, .brightness = 0.25};
    EXPECT_THAT(api_.media(), ElementsAre(mist, sim::rain(10.0), steam));

    const HttpResponse cleared = ask("DELETE");
    EXPECT_EQ(cleared.status, 204);
    EXPECT_EQ(cleared.body, "");
    EXPECT_THAT(api_.media(), IsEmpty());
}

TEST_F(MediaRoutes, SayWhereNoScannerSeesThem) {
    api_.notes_ = {"nobody sees it"};
    EXPECT_EQ(ask("PUT", R"([{"kind":"snow","mm_per_hour":1}])").body,
              "{\"warnings\":[],\"notes\":[\"nobody sees it\"]}\n");
    EXPECT_THAT(api_.media(), ElementsAre(sim::snow(1.0)));
}

TEST_F(MediaRoutes, RefuseAWrongListByItsField) {
    ASSERT_EQ(ask("PUT", R"([{"kind":"snow","mm_per_hour":1}])").status, 200);
    const auto second = [](const std::string& medium) {
        return R"([{"kind":"rain","mm_per_hour":1},)" + medium + "]";
    };
    EXPECT_EQ(refusal(second(R"({"kind":"fog","visibility_m":0})")),
              "[1].visibility_m: [1].visibility_m must be 0.5 to 100000 m, not '0'");
    EXPECT_EQ(refusal(second(R"({"kind":"fog","visibility_m":"20"})")),
              "[1].visibility_m: [1].visibility_m must be a number");
    EXPECT_EQ(refusal(second(R"({"kind":"fog"})")), "[1]: [1] needs visibility_m");
    EXPECT_EQ(refusal(second(R"({"kind":"rain","mm_per_hour":2})")),
              "[1]: [1] needs a name, since another medium is 'rain'");
    EXPECT_EQ(refusal(second(R"({"kind":"fog","visibility_m":2,"name":"rain"})")),
              "[1].name: [1].name is taken: another is 'rain'");
    EXPECT_EQ(refusal(second(R"({"kind":"fog","visibility_m":2,"name":""})")),
              "[1].name: [1].name must be a text that is not empty");
    EXPECT_EQ(refusal(second(R"({"kind":"mud"})")),
              "[1].kind: [1].kind must be fog, rain, snow, dust or custom, not 'mud'");
    EXPECT_EQ(refusal(second(R"({"kind":"fog","visibility_m":2,"colour":1})")),
              "[1].colour: [1].colour is no key of a medium");
    EXPECT_EQ(refusal(second("7")), R"([1]: [1] must be an object such as {"kind":"fog",..})");
    EXPECT_THAT(api_.media(), ElementsAre(sim::snow(1.0)));
}

TEST_F(MediaRoutes, RefuseAWrongBox) {
    const auto box = [](const std::string& box) {
        return R"([{"kind":"fog","visibility_m":2,"box":)" + box + "}]";
    };
    EXPECT_EQ(refusal(box("[0,0,0,1,1,1]")),
              R"([0].box: [0].box must be {"from":[X,Y,Z],"to":[X,Y,Z]})");
    const std::string corners =
        "[0].box: [0].box must have from and to, three numbers within 1e7 m each";
    EXPECT_EQ(refusal(box(R"({"from":[0,0,0],"till":[1,1,1]})")), corners);
    EXPECT_EQ(refusal(box(R"({"from":[0,0,"0"],"to":[1,1,1]})")), corners);
    EXPECT_EQ(refusal(box(R"({"from":[0,0,0],"to":[1,1,1e8]})")), corners);
    EXPECT_EQ(refusal(box(R"({"from":[0,0,0],"to":[1,-1,1]})")),
              "[0].box: [0].box must go from the lowest corner to the highest in x, y and z");
}

TEST_F(MediaRoutes, RefuseWhatIsNoListOrTooLong) {
    const std::string sentence = "-: the body must be a list of at most 64 media";
    EXPECT_EQ(refusal(R"({"kind":"fog","visibility_m":2})"), sentence);
    json list = json::array();
    for (int i = 0; i < 64; ++i) {
        list.push_back({{"kind", "custom"},
                        {"name", std::to_string(i)},
                        {"extinction_per_m", 0.1},
                        {"returns_per_m", 1},
                        {"brightness", 1},
                        {"box", {{"from", {0, 0, 0}}, {"to", {1, 1, 1}}}}});
    }
    EXPECT_EQ(ask("PUT", list.dump()).status, 200);
    list.push_back({{"kind", "fog"}, {"visibility_m", 2}});
    EXPECT_EQ(refusal(list.dump()), sentence);
    EXPECT_EQ(refusal("[").substr(0, 37), "-: the body must be a list of media: ");
    EXPECT_EQ(api_.media().size(), 64U);
}

}  // namespace
}  // namespace scipd::daemon
