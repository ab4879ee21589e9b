// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files that mean harm, or would do it: refused with a reason, in no time and little memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SdfLimits : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& text, SdfOptions options = {}) {
        options.strict = true;
        const auto file = folder_.write("a.sdf", text);
        return faults_of([&] { load_sdf(file, options); }, folder_);
    }
    static std::string numbered(std::string text, int number, const std::string& behind = {}) {
        return text.append(std::to_string(number)).append(behind);
    }
    static std::string include(const std::string& uri, const std::string& name) {
        return "<include><uri>" + uri + "</uri><name>" + name + "</name></include>\n";
    }
    void write_model(const std::string& name, const std::string& inside) {
        folder_.write(name, sdf("<model name='m'><link name='l'/>" + inside + "</model>"));
    }
    TempDir folder_;
};

TEST_F(SdfLimits, WhatIncludesItself) {
    write_model("b.sdf", include("b.sdf", "x"));
    EXPECT_THAT(faults(world(include("b.sdf", "x"))), ElementsAre("b.sdf:3: includes itself"));
    write_model("b.sdf", include("c.sdf", "x"));
    write_model("c.sdf", include("b.sdf", "x"));
    EXPECT_THAT(faults(world(include("b.sdf", "x"))),
                ElementsAre("c.sdf:3: includes itself, through others"));
}

TEST_F(SdfLimits, WhatIncludesItselfOverALink) {
    std::filesystem::create_directory_symlink(".", folder_.path() / "d");
    folder_.write("self.sdf", sdf("<model name='m'>" + include("d/self.sdf", "x") + "</model>"));
    EXPECT_THAT(faults(world(include("self.sdf", "x"))),
                ElementsAre(testing::HasSubstr("includes itself")));
}

TEST_F(SdfLimits, WhatIncludesTooDeeply) {
    for (int i = 0; i < 40; ++i)
        write_model(numbered("", i, ".sdf"), include(numbered("", i + 1, ".sdf"), "x"));
    write_model("40.sdf", "");
    EXPECT_THAT(faults(world(include("0.sdf", "x"))),
                ElementsAre("30.sdf:3: includes are nested more than 32 deep"));
}

TEST_F(SdfLimits, WhatGrowsWithEveryInclude) {
    const auto ten_of = [&](const std::string& uri) {
        std::string text;
        for (int i = 0; i < 10; ++i)
            text += include(uri, numbered("n", i));
        return text;
    };
    for (int i = 0; i < 20; ++i)
        write_model(numbered("", i, ".sdf"), ten_of(numbered("", i + 1, ".sdf")));
    write_model("20.sdf", "");
    const auto all = faults(world(ten_of("0.sdf")), {.most_memory_bytes = 300'000'000});
    ASSERT_EQ(all.size(), 1U);
    EXPECT_THAT(all[0], HasSubstr("a.sdf: takes more than the 300 MB that are allowed, with all "
                                  "its includes; put parts that never move into one link or one "
                                  "mesh"));
}

TEST_F(SdfLimits, WhatIsLargeByItself) {
    std::string visuals;
    for (int i = 0; i < 100; ++i)
        visuals += visual(numbered("v", i), unit_box);
    write_model("b.sdf", "<link name='k'>" + visuals + "</link>");
    std::string many;
    for (int i = 0; i < 100; ++i)
        many += include("b.sdf", numbered("m", i));
    EXPECT_THAT(faults(world(many), {.most_memory_bytes = 10'000'000}),
                ElementsAre("a.sdf: takes more than the 10 MB that are allowed, with all its "
                            "includes; put parts that never move into one link or one mesh, or "
                            "allow more by world_memory_mb under limits in the configuration"));
    EXPECT_THAT(faults(world(many), {.most_memory_bytes = 100'000'000}), ElementsAre());
}

TEST_F(SdfLimits, WhatHasTooManyTriangles) {
    const auto spheres = visual("a", "<sphere><radius>2</radius></sphere>") +
                         visual("b", "<ellipsoid><radii>1 2 3</radii></ellipsoid>");
    EXPECT_THAT(
        faults(world(model_of(spheres)), {.most_triangles = 50'000}),
        ElementsAre("a.sdf:5: m::l::a: with this one the world has more than 50000 "
                    "triangles; world_triangles under limits in the configuration allows more",
                    "a.sdf:6: m::l::b: with this one the world has more than 50000 "
                    "triangles; world_triangles under limits in the configuration allows more"));
}

TEST_F(SdfLimits, WhatHasEndlessOutlines) {
    std::string points;
    for (int i = 0; i < 2001; ++i)
        points += numbered("<point>", i, i % 2 == 0 ? " 0</point>" : " 1</point>");
    EXPECT_THAT(
        faults(
            world(model_of(visual("a", "<polyline>" + points + "<height>1</height></polyline>") +
                           visual("b",
                                  "<polyline><point>0 0</point><point>1 0</point><height>1</height>"
                                  "</polyline>")))),
        ElementsAre("a.sdf:5: m::l::a: has 2001 outline points, at most 2000 are read; make "
                    "it a mesh",
                    "a.sdf:6: m::l::b: a <polyline> needs three <point>s at least"));
}

TEST_F(SdfLimits, WhatIsNestedTooDeeplyForXml) {
    std::string open;
    std::string close;
    for (int i = 0; i < 5000; ++i) {
        open += "<model name='m'>";
        close += "</model>";
    }
    EXPECT_THAT(faults(world(open + close)),
                ElementsAre(HasSubstr("is no XML that can be read: its elements lie in each other "
                                      "too deep")));
}

TEST_F(SdfLimits, EveryMissingIncludeIsToldAtOnce) {
    folder_.write("empty/model.sdf", "");
    const std::string lost = "model://" + folder_.path().filename().string() + "-lost";
    write_model("b.sdf", include(lost, "x"));
    EXPECT_THAT(
        faults(world(include("b.sdf", "b") + include("none.sdf", "c") + include("empty", "d"))),
        ElementsAre(HasSubstr("b.sdf:3: there is no '" + lost + "' near "),
                    HasSubstr("a.sdf:5: there is no 'none.sdf' near "),
                    HasSubstr("a.sdf:6: 'empty' is the folder ")));
}

TEST_F(SdfLimits, AModelNamesAFileOfAVersionThatIsRead) {
    folder_.write("m/old.sdf", sdf("<model name='old'><link name='l'/></model>"));
    folder_.write("m/new.sdf", sdf("<model name='new'>" + include("lost", "x") + "</model>"));
    const auto config = [&](const std::string& files) {
        folder_.write("m/model.config", "<model><name>m</name>" + files + "</model>");
        return faults(world(include("m", "m")));
    };
    const auto none = ElementsAre(
        "a.sdf:4: 'm' is the folder m, which has no model.config that names an SDF file");
    EXPECT_THAT(config("<sdf version='1.9'/>"), none);
    EXPECT_THAT(config(""), none);
    const auto reads_old = Contains(HasSubstr("holds nothing that a scanner could see"));
    const std::string old = "<sdf version='1.6'>old.sdf</sdf>";
    EXPECT_THAT(config(old + "<sdf version='1.13'>new.sdf</sdf>"), reads_old);
    EXPECT_THAT(config("<sdf version='1.5'>new.sdf</sdf>" + old), reads_old);
    EXPECT_THAT(config("<sdf>new.sdf</sdf>" + old), reads_old);
    const auto reads_new = ElementsAre(HasSubstr("m/new.sdf:3: there is no 'lost'"));
    EXPECT_THAT(config("<sdf>new.sdf</sdf>"), reads_new);
    EXPECT_THAT(config("<sdf version='1.13'>new.sdf</sdf>"), reads_new);
}

}  // namespace
}  // namespace scipd::sim
