// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The names of topics, and what is kept under them.
#include "daemon/fleet/topics.h"

#include <gtest/gtest.h>

#include "daemon/fleet/kept_messages.h"

namespace scipd::daemon {
namespace {

using Kind = Topic::Kind;

TEST(Topics, HaveTheWordsOfTheDocumentation) {
    const Topics topics("hall");
    EXPECT_EQ(topics.of(Kind::poses), "scipd/hall/poses");
    EXPECT_EQ(topics.of(Kind::places, "east"), "scipd/hall/places/east");
    EXPECT_EQ(topics.of(Kind::model, "crate"), "scipd/hall/models/crate");
    EXPECT_EQ(topics.of(Kind::scene), "scipd/hall/scene");
    EXPECT_EQ(topics.of(Kind::daemon, "east"), "scipd/hall/daemons/east");
    EXPECT_EQ(topics.all(Kind::model), "scipd/hall/models/+");
    EXPECT_EQ(topics.all(Kind::scene), "scipd/hall/scene");
}

TEST(Topics, HoldAnyName) {
    const Topics topics("hall");
    EXPECT_EQ(topics.of(Kind::model, "a/b #+%é"), "scipd/hall/models/a%2Fb%20%23%2B%25%C3%A9");
    for (const std::string& name : {std::string("truck::lamp"), std::string("a/b+#%"),
                                    std::string("\xff\x00z", 3), std::string("..")}) {
        EXPECT_EQ(topics.read(topics.of(Kind::model, name)), (Topic{Kind::model, name})) << name;
    }
}

TEST(Topics, OfOthersAreNotRead) {
    const Topics topics("hall");
    EXPECT_EQ(topics.read("scipd/hall/poses"), (Topic{Kind::poses, ""}));
    for (const char* other :
         {"", "scipd/hall", "scipd/hall/", "scipd/hallway/poses", "hall/poses", "scipd/hall/models",
          "scipd/hall/models/", "scipd/hall/models/a/b", "scipd/hall/models/%4",
          "scipd/hall/models/%GG", "scipd/hall/poses/a", "scipd/hall/news"}) {
        EXPECT_FALSE(topics.read(other)) << other;
    }
}

TEST(KeptMessages, AreTheLastOfTheirTopics) {
    KeptMessages kept;
    kept.take({Kind::model, "crate"}, "one");
    kept.take({Kind::model, "crate"}, "two");
    kept.take({Kind::model, "post"}, "three");
    kept.take({Kind::model, "post"}, "");
    EXPECT_EQ(kept.models, (std::map<std::string, std::string>{{"crate", "two"}}));
    kept.take({Kind::scene, ""}, R"({"hash":"1"})");
    ASSERT_TRUE(kept.scene);
    EXPECT_EQ(kept.scene->hash, "1");
    kept.take({Kind::scene, ""}, "");
    EXPECT_FALSE(kept.scene);
}

TEST(KeptMessages, TellWhoServes) {
    KeptMessages kept;
    kept.take({Kind::daemon, "east"}, R"({"name":"east","state":"lost","instance":"1"})");
    EXPECT_EQ(kept.serving_other_than("9"), nullptr);
    kept.take({Kind::daemon, "west"}, R"({"name":"west","state":"serving","instance":"2"})");
    ASSERT_NE(kept.serving_other_than("9"), nullptr);
    EXPECT_EQ(kept.serving_other_than("9")->name, "west");
    EXPECT_EQ(kept.serving_other_than("2"), nullptr);
}

}  // namespace
}  // namespace scipd::daemon
