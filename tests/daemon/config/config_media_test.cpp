// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a configuration says of rain, fog, snow and dust.
#include <gmock/gmock.h>

#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Sentences = std::vector<std::string>;

class ConfigMedia : public ConfigFixture {
  protected:
    /// Without the lines of a whole configuration around this list.
    std::vector<sim::Medium> media(const std::string& list) const {
        return parse(list + with("")).media;
    }
    Sentences media_faults(const std::string& list) const { return faults(list + with("")); }
};

TEST_F(ConfigMedia, FillTheAirAsTheirKindsDo) {
    const auto media = this->media(
        "media:\n"
        "  - {kind: fog, visibility_m: 20, name: mist, box: {from: [0, 1, 2], to: [3, 4, 5]}}\n"
        "  - {kind: rain, mm_per_hour: 12.5}\n"
        "  - {kind: snow, mm_per_hour: 2}\n"
        "  - {kind: dust, visibility_m: 40}\n");
    sim::Medium mist = sim::fog(20.0);
    mist.name = "mist";
    mist.low_m = {0.0, 1.0, 2.0};
    mist.high_m = {3.0, 4.0, 5.0};
    EXPECT_THAT(media, ElementsAre(mist, sim::rain(12.5), sim::snow(2.0), sim::dust(40.0)));
    EXPECT_EQ(media.at(0).kind, "fog");
    EXPECT_EQ(media.at(0).amount, 20.0);
    EXPECT_THAT(parse(with("")).media, IsEmpty());
    EXPECT_THAT(this->media("media: []\n"), IsEmpty());
}

TEST_F(ConfigMedia, CanBeOfOnesOwn) {
    const sim::Medium steam{
        .name = "steam", .extinction_per_m = 0.5, .returns_per_m = 2.0, .brightness = 0.25};
    EXPECT_THAT(media("media: [{kind: custom, name: steam, extinction_per_m: 0.5, "
                      "returns_per_m: 2, brightness: 0.25}]\n"),
                ElementsAre(steam));
    const sim::Medium haze{.name = "custom", .extinction_per_m = 0.01};
    EXPECT_THAT(media("media: [{kind: custom, extinction_per_m: 0.01}]\n"), ElementsAre(haze));
}

TEST_F(ConfigMedia, TellTheirFaultsWithLineAndKey) {
    EXPECT_THAT(
        media_faults("media:\n"
                     "  - {visibility_m: 20}\n"
                     "  - {kind: mud}\n"
                     "  - {kind: fog}\n"
                     "  - kind: fog\n"
                     "    visibility_m: 0.4\n"
                     "  - {kind: rain, mm_per_hour: 5, visibility_m: 20}\n"
                     "  - {kind: rain, mm_per_hour: nan, colour: red}\n"
                     "  - {kind: dust, visibility_m: 20, box: {from: [0, 0, 0]}}\n"
                     "  - {kind: snow, mm_per_hour: 1, box: {from: [0, 0, 0], to: [1, 0, 1]}}\n"
                     "  - {kind: snow, mm_per_hour: 1, box: [0, 0, 0, 1, 1, 1]}\n"),
        ElementsAre(
            "rig.yaml:2: media: needs kind: fog, rain, snow, dust or custom",
            "rig.yaml:3: media.kind: must be fog, rain, snow, dust or custom, not 'mud'",
            "rig.yaml:4: media: needs visibility_m",
            "rig.yaml:6: media.visibility_m: must be 0.5 to 100000 m, not '0.4'",
            "rig.yaml:7: media.visibility_m: is not of rain; leave it out",
            "rig.yaml:8: media.colour: unknown key; known here are kind, name, box, "
            "visibility_m, mm_per_hour, extinction_per_m, returns_per_m, brightness",
            "rig.yaml:8: media.mm_per_hour: must be a number, not 'nan'",
            "rig.yaml:9: media.box: needs to",
            "rig.yaml:10: media.box: must go from the lowest corner to the highest in x, y and z",
            "rig.yaml:11: media.box: must be a map of keys and values, such as box: {from: [0, 0, "
            "0], "
            "to: [3, 2, 2.5]}"));
}

TEST_F(ConfigMedia, AreBoundInEachNumber) {
    const auto fault = [this](const std::string& medium) {
        const auto faults = media_faults("media: [{" + medium + "}]\n");
        return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
    };
    const std::string place = "rig.yaml:1: media.";
    EXPECT_EQ(fault("kind: fog, visibility_m: 100001"),
              place + "visibility_m: must be 0.5 to 100000 m, not '100001'");
    EXPECT_EQ(fault("kind: snow, mm_per_hour: 501"),
              place + "mm_per_hour: must be 0 to 500 mm an hour, not '501'");
    EXPECT_EQ(fault("kind: custom, extinction_per_m: -0.5"),
              place + "extinction_per_m: must be 0 to 100 a metre, not '-0.5'");
    EXPECT_EQ(fault("kind: custom, extinction_per_m: 0, returns_per_m: 1001"),
              place + "returns_per_m: must be 0 to 1000 a metre, not '1001'");
    EXPECT_EQ(fault("kind: custom, extinction_per_m: 0, brightness: 10.5"),
              place + "brightness: must be 0 to 10, not '10.5'");
    EXPECT_EQ(fault("kind: rain, mm_per_hour: 0"), "0 faults");
    EXPECT_EQ(fault("kind: rain, mm_per_hour: 500"), "0 faults");
    EXPECT_EQ(fault("kind: fog, visibility_m: 0.5"), "0 faults");
}

TEST_F(ConfigMedia, HaveNamesOfTheirOwn) {
    EXPECT_THAT(media_faults("media:\n"
                             "  - {kind: fog, visibility_m: 20}\n"
                             "  - {kind: fog, visibility_m: 30}\n"
                             "  - {kind: rain, mm_per_hour: 3, name: fog}\n"
                             "  - {kind: rain, mm_per_hour: 3, name: \"a\\tb\"}\n"),
                ElementsAre("rig.yaml:3: media: needs a name, since another medium is 'fog'",
                            "rig.yaml:4: media.name: is taken: another is 'fog'",
                            "rig.yaml:5: media.name: must be UTF-8 without control characters"));
}

TEST_F(ConfigMedia, AreAtMost64) {
    std::string list = "media:\n";
    for (int i = 0; i < 64; ++i)
        list += "  - {kind: rain, mm_per_hour: 1, name: r" + std::to_string(i) + "}\n";
    EXPECT_EQ(media(list).size(), 64U);
    EXPECT_THAT(media_faults(list + "  - {kind: snow, mm_per_hour: 1}\n"),
                ElementsAre("rig.yaml:1: media: must be a list of at most 64, in brackets"));
    EXPECT_THAT(media_faults("media: fog\n"),
                ElementsAre("rig.yaml:1: media: must be a list of at most 64, in brackets"));
}

}  // namespace
}  // namespace scipd::daemon
