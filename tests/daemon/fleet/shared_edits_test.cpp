// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What becomes of changes that others tell, without a broker.
#include "daemon/fleet/shared_edits.h"

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/fleet/model_message.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;
using Result = EditOutcome::Result;

std::string crate_of(const std::string& sdf, const std::string& name = "crate") {
    AddModel edit;
    edit.placement.name = name;
    edit.sdf = sdf;
    return text_of(edit);
}

class SharedEditsTest : public testing::Test {
  protected:
    SharedEditsTest() {
        base_.models = {{.name = "pillar"}};
        edits_.begin(base_, {{"old", crate_of("<old/>", "old")}});
    }

    /// Notes what is asked for, and answers at once.
    void edit_here(const SceneEdit& edit, const EditDone& done) {
        const auto* const add = std::get_if<AddModel>(&edit);
        asked_.push_back(add != nullptr ? "add " + add->placement.name + " " + add->sdf
                                        : "remove " + std::get<RemoveModel>(edit).name);
        done({result_, {"why not"}});
    }

    std::vector<std::string> asked() { return std::exchange(asked_, {}); }

    boost::asio::io_context io_;
    FleetConfig config_{.broker = {"127.0.0.1", 1}, .world = "hall"};
    Topics topics_{"hall"};
    MqttLink link_{io_.get_executor(), config_, "test", {}, {}};
    sim::Scene base_;
    std::vector<std::string> asked_;
    std::map<std::string, std::string> differs_;  ///< why, by model
    Result result_ = Result::done;
    SharedEdits edits_{link_,
                       topics_,
                       {.edit = [this](SceneEdit edit, EditDone done) { edit_here(edit, done); },
                        .changed = [](const std::string&) {},
                        .differs =
                            [this](const std::string& model, const std::string& why) {
                                differs_[model] = why;
                                if (why.empty()) differs_.erase(model);
                            }}};
};

TEST_F(SharedEditsTest, AreMadeOnceAndInTheOrderInWhichTheyCome) {
    edits_.take("crate", crate_of("<one/>"));
    edits_.take("crate", crate_of("<one/>"));
    edits_.take("crate", crate_of("<two/>"));
    edits_.take("crate", crate_of("<one/>"));
    EXPECT_THAT(asked(), ElementsAre("add crate <one/>", "add crate <two/>", "add crate <one/>"));
    edits_.take("crate", "");
    edits_.take("crate", "");
    edits_.take("pillar", std::string(gone));
    edits_.take("old", crate_of("<old/>", "old"));
    EXPECT_THAT(asked(), ElementsAre("remove crate", "remove pillar"));
}

TEST_F(SharedEditsTest, OfATimeWithoutTheBrokerAreMadeUpFor) {
    edits_.take("crate", crate_of("<one/>"));
    edits_.take("post", crate_of("<post/>", "post"));
    (void)asked();
    edits_.take_all({{"crate", crate_of("<two/>")}, {"old", crate_of("<old/>", "old")}});
    EXPECT_THAT(asked(), ElementsAre("remove post", "add crate <two/>"));
}

TEST_F(SharedEditsTest, ThatCannotBeMadeAreTold) {
    edits_.take("crate", "{}");
    EXPECT_THAT(differs_, ElementsAre(Pair("crate", HasSubstr("name is missing"))));
    result_ = Result::faulty;
    edits_.take("post", crate_of("<post/>", "post"));
    result_ = Result::done;
    edits_.take("crate", crate_of("<one/>"));
    EXPECT_THAT(differs_, ElementsAre(Pair("post", "why not")));
    edits_.take("post", "");
    EXPECT_THAT(differs_, IsEmpty());
}

TEST_F(SharedEditsTest, ThatMakeNoSenseAreForgottenWithTheirMessages) {
    edits_.take("crate", "{}");
    edits_.take("crate", "");
    EXPECT_THAT(differs_, IsEmpty());
    // A model of the base world stands as before, while and after somebody has said nonsense of it.
    edits_.take("pillar", "nonsense");
    EXPECT_THAT(differs_, ElementsAre(Pair("pillar", HasSubstr("JSON"))));
    edits_.take("pillar", "");
    EXPECT_THAT(differs_, IsEmpty());
    result_ = Result::forbidden;
    edits_.take("pillar", crate_of("<other/>", "pillar"));
    EXPECT_THAT(differs_, ElementsAre(Pair("pillar", "why not")));
    EXPECT_THAT(SharedEdits::edits_for(base_, edits_.texts()), SizeIs(1)) << "that of old alone";
    edits_.take("pillar", "");
    EXPECT_THAT(differs_, IsEmpty());
    EXPECT_THAT(asked(), ElementsAre("add pillar <other/>"));
}

TEST_F(SharedEditsTest, ThatCouldNotBeMadeAtTheStartAreToldAndTriedAgain) {
    edits_.begin(base_, {{"broken", "{}"}, {"post", crate_of("<post/>", "post")}});
    edits_.differ({{"post", "its file is not there"}});
    EXPECT_THAT(differs_, ElementsAre(Pair("broken", HasSubstr("name is missing")),
                                      Pair("post", "its file is not there")));
    edits_.try_again();
    EXPECT_THAT(asked(), ElementsAre("add post <post/>"));
    EXPECT_THAT(differs_, ElementsAre(Pair("broken", HasSubstr("name is missing"))));
    edits_.take("broken", "");
    EXPECT_THAT(differs_, IsEmpty());
}

TEST_F(SharedEditsTest, AskedForHereWaitForTheBroker) {
    std::vector<Result> results;
    const auto done = [&](const EditOutcome& outcome) { results.push_back(outcome.result); };
    edits_.edit(RemoveModel{"pillar"}, done);
    edits_.edit(LoadWorld{"other.sdf"}, done);
    EXPECT_THAT(results, ElementsAre(Result::not_now, Result::forbidden));
    EXPECT_THAT(asked(), IsEmpty());
}

TEST_F(SharedEditsTest, BringABaseWorldToWhereTheOthersAre) {
    const auto edits = SharedEdits::edits_for(
        base_,
        {{"crate", crate_of("<one/>")}, {"pillar", std::string(gone)}, {"x", "{\"remove\":true}"}});
    ASSERT_EQ(edits.size(), 2U);
    EXPECT_EQ(std::get<AddModel>(edits[0]).sdf, "<one/>");
    EXPECT_EQ(std::get<RemoveModel>(edits[1]).name, "pillar");
    EXPECT_THAT(SharedEdits::edits_for(base_, {{"crate", "{}"}}), IsEmpty());
}

}  // namespace
}  // namespace scipd::daemon
