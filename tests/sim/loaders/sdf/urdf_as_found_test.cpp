// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Robots with the faults that those of public repositories have: two boxes 3 m apart, which every
// scanner sees all the same, and what is left out is told.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_cast.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string box = "<geometry><box size='1 1 1'/></geometry>";
const std::string limit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";

/// What is in the links and the joint on lines 2 to 4, and behind them.
struct Parts {
    std::string a = {};
    std::string b = {};
    std::string type = "revolute";
    std::string joint = limit;
    std::string more = {};
};

struct Found {
    Parts robot;
    std::string told = {};  ///< empty where nothing is
};

std::string text_of(const Parts& parts, const std::string& shown = "visual") {
    const std::string seen = '<' + shown + '>' + box + "</" + shown + '>';
    return "<robot name='r'>\n<link name='a'>" + parts.a + seen + "</link>\n<link name='b'>" +
           seen + parts.b + "</link>\n<joint name='j' type='" + parts.type +
           "'><origin xyz='3 0 0'/><parent link='a'/><child link='b'/>" + parts.joint +
           "</joint>\n" + parts.more + "</robot>\n";
}

std::string extension(const std::string& inside) {
    return "<gazebo reference='a'>" + inside + "</gazebo>";
}

const Found found[] = {
    {},
    {{.type = "rotary"}},
    {{.type = "floating"}},
    {{.joint = "<limit lower='0' upper='1'/>"}},
    {{.joint = ""}},
    {{.joint = "<axis xyz='0 0 0'/>" + limit}},
    {{.joint = "<axis xyz='z'/>" + limit}},
    {{.joint = limit + "<mimic/>"}},
    {{.joint = limit + "<safety_controller/>"}},
    {{.joint = limit + "<dynamics damping='a'/>"}},
    {{.joint = limit + "<calibration rising='a'/>"}},
    {{.a = "<collision/>"}},
    {{.a = "<collision><geometry/></collision>"}},
    {{.a = "<collision><geometry><mesh/></geometry></collision>"}},
    {{.a = "<inertial><mass value='x'/></inertial>"}},
    {{.more = extension("<visual><material><script><name>Gazebo/Red</name></script></material>"
                        "</visual>")}},
    {{.a = "<collision>" + box + "</collision>", .more = extension("<mu1></mu1>")}},
    {{.a = "<collision>" + box + "</collision>",
      .more = extension("<maxContacts>-</maxContacts>")}},
    {{.a = "<collision>" + box + "</collision>", .more = extension("<fdir1>q</fdir1>")}},
    {{.more = "<gazebo><model name='q'/></gazebo>"}},
    {{.more = "<gazebo><static>words</static></gazebo>"},
     "5: r: its <static> 'words' cannot be read: write true or false; ignored"},
    {{.more = "<gazebo><pose>1 2</pose></gazebo>"},
     "5: r: its <pose> '1 2' cannot be read: write 6 numbers, with blanks between; ignored"},
    {{.more = "<transmission/><sensor name='x'><parent link='q'/><ray/></sensor>"}},
    {{.more = "<material name='m'><color rgba='1 0'/></material><material name='m'/>"}},
    {{.b = "<visual/>"}, "3: r::b::b_visual_1: it has no <geometry>; left out"},
    {{.b = "<visual><geometry/></visual>"},
     "3: r::b::b_visual_1: its <geometry> is empty; left out"},
    {{.b = "<visual name='lid'><geometry><capsule radius='1' length='1'/></geometry></visual>"},
     "3: r::b::b_fixed_joint_lump__lid_visual_1: URDF has no <capsule>; left out"},
    {{.b = "<visual><geometry><box size='1 NaN 1'/></geometry></visual>"},
     "3: r::b::b_visual_1: its <box size='1 NaN 1'> cannot be read; left out"},
    {{.b = "<visual><geometry><cylinder radius='1'/></geometry></visual>"},
     "3: r::b::b_visual_1: its <cylinder> has no length; left out"},
    {{.b = "<visual><geometry><mesh/></geometry></visual>"},
     "3: r::b::b_visual_1: its <mesh> has no filename; left out"},
    {{.b = "<visual><origin xyz='1 0'/>" + box + "</visual>"},
     "3: r::b::b_visual_1: its <origin xyz='1 0'> cannot be read; left out"},
};

class UrdfAsFound : public SdfCast {
  protected:
    void expect_told(const std::string& told) {
        const std::string prefix = (folder_.path() / "a.sdf:").string();
        if (told.empty()) {
            EXPECT_THAT(warnings_, IsEmpty());
        } else {
            EXPECT_THAT(warnings_, ElementsAre(prefix + told));
        }
    }
};

TEST_P(UrdfAsFound, isSeenAndTold) {
    for (const Found& one : found) {
        const std::string text = text_of(one.robot);
        SCOPED_TRACE(text);
        ASSERT_NO_THROW(load(text));
        ASSERT_EQ(scene_->objects.size(), 2U);
        EXPECT_EQ(scene_->objects[0].name, "r::a::a_visual");
        EXPECT_EQ(scene_->objects[1].name, "r::b::b_visual");
        EXPECT_NEAR(down_m(0, 0), 9.5, 1e-3);
        EXPECT_NEAR(down_m(3, 0), 9.5, 1e-3);
        EXPECT_EQ(down_m(1.5, 0), nothing);
        expect_told(one.told);
    }
}

TEST(UrdfAsFoundStrict, isRefusedWhereEveryWordCounts) {
    const TempDir folder;
    for (const Found& one : found) {
        SCOPED_TRACE(text_of(one.robot));
        const auto file = folder.write("a.urdf", text_of(one.robot));
        const auto faults = faults_of([&] { load_sdf(file, {.strict = true}); }, folder);
        EXPECT_EQ(faults.empty(), one.told.empty());
    }
}

TEST_P(UrdfAsFound, hasCollisionsThatCostNoMoreThanThemselves) {
    load(text_of({.a = "<visual/>", .b = "<collision><geometry/></collision>"}, "collision"),
         {.geometry = SdfGeometry::collision});
    ASSERT_EQ(scene_->objects.size(), 2U);
    EXPECT_NEAR(down_m(3, 0), 9.5, 1e-3);
    expect_told("3: r::b::b_collision_1: its <geometry> is empty; left out");
}

TEST_P(UrdfAsFound, tellsALinkOfCollisionsAlone) {
    load(text_of({.more = "<link name='c'><collision><geometry/></collision></link><joint name='k' "
                          "type='fixed'><parent link='a'/><child link='c'/></joint>"}));
    expect_told(
        "5: r::c has collisions but no visual; scanners see visuals only; with geometry: collision "
        "or --geometry collision they see collisions only");
}

TEST_P(UrdfAsFound, keepsWhatItsExtensionsSayOfSurfaces) {
    load(text_of({.a = "<collision>" + box + "</collision>",
                  .more = extension("<mu1></mu1><material>Gazebo/Red</material>"
                                    "<laserRetro>200</laserRetro><kp>x</kp>") +
                          "<gazebo><static>true</static><plugin/></gazebo>"}));
    ASSERT_EQ(scene_->objects.size(), 2U);
    const Material& material = scene_->materials.at(scene_->objects[0].material);
    EXPECT_EQ(material.name, "Gazebo/Red");
    EXPECT_EQ(material.laser_retro, 200.0);
    EXPECT_FALSE(scene_->models.at(0).movable);
}

INSTANTIATE_TEST_SUITE_P(Backends, UrdfAsFound, ::testing::Values("embree", "reference"),
                         name_of_backend);

}  // namespace
}  // namespace scipd::sim
