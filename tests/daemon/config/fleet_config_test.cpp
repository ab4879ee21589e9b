// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The key that says which world a daemon shares with others.
#include <filesystem>

#include <gmock/gmock.h>

#include "daemon/config/fleet.h"
#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::StartsWith;
namespace fs = std::filesystem;

class FleetConfigTest : public ConfigFixture {
  protected:
    FleetConfigTest() {
        fs::permissions(dir_.write("user", "east:pass:word\n"), fs::perms(0600));
        dir_.write("ca.pem", "");
    }

    /// Its key `fleet` stands in line 3.
    static std::string with_fleet(const std::string& text) {
        return "scene: room.sdf\nrobots: {r: {sensors: {s: {pty: auto, model: UST-10LX}}}}\n"
               "fleet: {" +
               text + "}\n";
    }
};

TEST_F(FleetConfigTest, SaysWhichWorldIsSharedAndByWhichBroker) {
    const auto fleet = parse(with_fleet("broker: 'mqtts://hub.example', world: hall.2, name: east, "
                                        "user_file: user, tls: {ca: ca.pem}, near_m: 60"))
                           .fleet;
    ASSERT_TRUE(fleet);
    EXPECT_EQ(fleet->broker, (BrokerAddress{"hub.example", 8883, true}));
    EXPECT_EQ(fleet->world, "hall.2");
    EXPECT_EQ(fleet->name, "east");
    EXPECT_EQ(fleet->user, (BrokerUser{"east", "pass:word"}));
    EXPECT_EQ(fleet->tls.ca, dir_.path() / "ca.pem");
    EXPECT_EQ(fleet->near_m, 60.0);
    EXPECT_FALSE(
        parse("scene: room.sdf\nrobots: {r: {sensors: {s: {pty: auto, model: UST-10LX}}}}").fleet);
}

TEST_F(FleetConfigTest, TellsWhatIsMissingAndWhatDoesNotFit) {
    EXPECT_THAT(faults(with_fleet("broker: mqtt://a")),
                ElementsAre("rig.yaml:3: fleet: needs world, such as {broker: "
                            "mqtt://127.0.0.1:1883, world: warehouse}"));
    EXPECT_THAT(faults(with_fleet("broker: mqtt://a, world: w, tls: {cert: ca.pem}")),
                ElementsAre("rig.yaml:3: fleet.tls: needs a broker: mqtts://HOST:PORT",
                            "rig.yaml:3: fleet.tls: cert and key go together"));
    dir_.write("user", "nobody\n");
    EXPECT_THAT(faults(with_fleet("broker: mqtt://a, world: w, user_file: user")),
                ElementsAre("rig.yaml:3: fleet.user_file: the first line of the file must be "
                            "USER:PASSWORD"));
}

TEST_F(FleetConfigTest, VehiclesTellTheirPosesByTheBroker) {
    const auto with_poses = [](const std::string& source, const std::string& more) {
        return "scene: room.sdf\nrobots:\n  tug:\n    poses: " + source +
               "\n    sensors: {s: {pty: auto, model: UST-10LX}}\n" + more;
    };
    const std::string fleet = "fleet: {broker: mqtt://a, world: w}\n";
    for (const std::string vehicle : {"ACME", "ACME/tug-1"}) {
        const auto poses = parse(with_poses("vda5050:" + vehicle, fleet)).robots.at(0).poses;
        ASSERT_TRUE(poses);
        EXPECT_EQ(poses->kind, PoseSource::Kind::vda5050);
        EXPECT_EQ(poses->vehicle, vehicle);
    }
    EXPECT_THAT(faults(with_poses("vda5050:ACME", "")),
                ElementsAre("rig.yaml:4: robots.tug.poses: needs fleet, by whose broker vehicles "
                            "tell where they are"));
    for (const char* bad : {"'vda5050:'", "vda5050:a/b/c", "vda5050:a+", "vda5050:/a"}) {
        EXPECT_THAT(faults(with_poses(bad, fleet)),
                    ElementsAre(StartsWith("rig.yaml:4: robots.tug.poses: must be vda5050:")));
    }
}

TEST(BrokerAddress, IsAnUrl) {
    EXPECT_EQ(parse_broker("mqtt://127.0.0.1"), (BrokerAddress{"127.0.0.1", 1883, false}));
    EXPECT_EQ(parse_broker("mqtt://[fe80::1]:99"), (BrokerAddress{"fe80::1", 99, false}));
    EXPECT_EQ(text_of(*parse_broker("mqtt://[fe80::1]:99")), "mqtt://[fe80::1]:99");
    EXPECT_EQ(text_of(*parse_broker("mqtts://hub")), "mqtts://hub:8883");
    for (const char* bad : {"", "mqtt://", "mqtt://a:0", "mqtt://a:65536", "mqtt://a:1x", "a:1883",
                            "mqtt://a/b", "mqtt://[::1", "mqtt://[::1]x", "mqtt://a b"}) {
        EXPECT_FALSE(parse_broker(bad)) << bad;
    }
    EXPECT_THAT(parse_broker("mqtt://me:it@a").error().why, StartsWith("must hold no user"));
}

TEST(BrokerAddress, IsNamedTogetherWithAWorld) {
    const auto both = parse_broker_and_world("mqtt://hub:99/hall");
    ASSERT_TRUE(both);
    EXPECT_EQ(both->broker, (BrokerAddress{"hub", 99, false}));
    EXPECT_EQ(both->world, "hall");
    for (const char* bad : {"mqtt://hub:99", "mqtt://hub:99/", "mqtt://hub/a/b", "hub/a"})
        EXPECT_FALSE(parse_broker_and_world(bad)) << bad;
}

}  // namespace
}  // namespace scipd::daemon
