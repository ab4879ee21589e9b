// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Terrains from elevation models, as text grids and as TIFF by hand.
#include <cstdint>
#include <cstring>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/sdf/sdf_cast.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Rows from the north.
std::string asc(std::size_t columns, const std::vector<double>& elevations_m) {
    std::ostringstream text;
    text << "ncols " << columns << "\nnrows " << elevations_m.size() / columns
         << "\nxllcorner 500000\nyllcorner 0\ncellsize 10\nNODATA_value -7777\n";
    for (std::size_t i = 0; i < elevations_m.size(); ++i)
        text << elevations_m[i] << ((i + 1) % columns == 0 ? '\n' : ' ');
    return text.str();
}

/// A square of floats, without any place on Earth.
std::string tiff(std::uint16_t side, const std::vector<float>& elevations_m) {
    std::string bytes = "II";
    const auto add = [&](auto value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const auto tag = [&](std::uint16_t name, std::uint16_t type, std::uint32_t value) {
        add(name);
        add(type);
        add(std::uint32_t{1});
        add(value);
    };
    constexpr std::uint16_t tags = 10;
    const std::uint32_t size = 4U * side * side;
    add(std::uint16_t{42});
    add(std::uint32_t{8});
    add(tags);
    tag(256, 3, side);                   // width
    tag(257, 3, side);                   // length
    tag(258, 3, 32);                     // bits a sample
    tag(259, 3, 1);                      // not compressed
    tag(262, 3, 1);                      // black is 0
    tag(273, 4, 8 + 2 + 12 * tags + 4);  // where the strip begins
    tag(277, 3, 1);                      // samples a pixel
    tag(278, 3, side);                   // rows a strip
    tag(279, 4, size);                   // bytes of it
    tag(339, 3, 3);                      // floats
    add(std::uint32_t{0});
    for (const float elevation_m : elevations_m)
        add(elevation_m);
    return bytes;
}

class SdfDem : public SdfCast {
  protected:
    void load_terrain(const std::string& uri, const std::string& more) {
        load(world(
            model_of(visual("v", "<heightmap><uri>" + uri + "</uri>" + more + "</heightmap>"))));
    }
};

INSTANTIATE_TEST_SUITE_P(Backends, SdfDem, ::testing::Values("reference", "embree"),
                         name_of_backend);

TEST_P(SdfDem, SpreadsItsElevationsOverTheSizeFromTheLowestOn) {
    folder_.write("a.asc", asc(3, {3, 4, 5, 3, 4, 5, 3, 4, 5}));
    load_terrain("a.asc", "<size>8 4 4</size>");
    EXPECT_THAT(warnings_, IsEmpty());
    // 3 m in the west, and twice as steep as it is: 7 m in the east.
    for (double x = -3.9; x < 4.0; x += 0.6)
        EXPECT_NEAR(down_m(x, 0.7), 10.0 - 3.0 - 0.5 * (x + 4.0), 1e-4) << x;
    EXPECT_NEAR(range_m({-6, 0.3, 5}, {1, 0, 0}), 6.0, 1e-4);
}

TEST_P(SdfDem, ATiffHasItsFirstRowInTheNorth) {
    folder_.write("a.tif", tiff(3, {2, 0, 0, 0, 0, 0, 0, 0, 0}));
    load_terrain("a.tif", "<size>8 4 6</size><pos>0 0 -1</pos>");
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_NEAR(down_m(-3.9999, 1.9999), 5.0, 1e-3);
    EXPECT_NEAR(down_m(3.9999, 1.9999), 11.0, 1e-3);
    EXPECT_NEAR(down_m(-3.9999, -1.9999), 11.0, 1e-3);
}

TEST_P(SdfDem, WhatItDoesNotKnowIsAsLowAsTheLowest) {
    folder_.write("a.asc", asc(3, {1, 1, 1, 1, -7777, 1, 0.5, 1, 3}));
    load_terrain("a.asc", "<size>2 2 2.5</size>");
    EXPECT_NEAR(down_m(0.0001, 0.0001), 9.5, 1e-3);
}

TEST_P(SdfDem, WithoutSizeItIsAsLargeAsOnEarth) {
    folder_.write("a.asc", asc(3, {1, 2, 3, 1, 2, 3, 1, 2, 3}));
    // Its corner lies on the equator, where the meridian of the zone is 0.04 % too short.
    folder_.write("a.prj",
                  "PROJCS[\"WGS_1984_UTM_Zone_31N\",GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\","
                  "SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],"
                  "UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
                  "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],"
                  "PARAMETER[\"Central_Meridian\",3.0],PARAMETER[\"Scale_Factor\",0.9996],"
                  "PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]");
    load_terrain("a.asc", "");
    EXPECT_THAT(warnings_, IsEmpty());
    // 30 m by the grid, times a sphere of 6371 km for an Earth of 6378 km, over 0.9996.
    const double width_m = 30.0 / 0.9996 * 6371.0 / 6378.137;
    EXPECT_NEAR(range_m({-50, 0.1, 1.5}, {1, 0, 0}), 50.0 - 0.25 * width_m, 1e-3);
    EXPECT_NEAR(down_m(0.5 * width_m - 0.001, 0.0), 7.0, 1e-3);
    EXPECT_EQ(down_m(0.5 * width_m + 0.001, 0.0), nothing);
}

TEST_P(SdfDem, OneThatIsNoSquareIsPadded) {
    folder_.write("a.asc", asc(4, {2, 2, 2, 2, 2, 2, 2, 1}));
    load_terrain("a.asc", "<size>4 4 1</size>");
    EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("a.asc: has 4 x 2 points"),
                                             HasSubstr("over 5 x 2 of a square of 5 x 5"))));
    EXPECT_NEAR(down_m(-1.9, 1.9), 8.0, 1e-4);
    EXPECT_NEAR(down_m(-1.9, 0.5), 8.5, 1e-4);
    EXPECT_NEAR(down_m(-1.9, -1.9), 9.0, 1e-4);
}

TEST_P(SdfDem, WhatCannotBeIsLeftOut) {
    folder_.write("a.tif", "no terrain");
    folder_.write("b.tif", tiff(3, {1, 2}));
    folder_.write("c.tif", tiff(2, {1, 2, 3, 4}));
    folder_.write("d.vrt", "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"/>");
    const auto of = [](const std::string& uri) {
        return "<heightmap><uri>" + uri + "</uri></heightmap>";
    };
    load(world(model_of(visual("a", of("a.tif")) + visual("b", of("b.tif")) +
                        visual("c", of("c.tif")) + visual("d", of("d.vrt")) +
                        visual("e", unit_box))));
    EXPECT_EQ(scene_->objects.size(), 1U);
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("a.tif: is neither a picture nor an elevation model"),
                            HasSubstr("b.tif: cannot be read"),
                            HasSubstr("c.tif: the <size> of a <heightmap> must be above 0"),
                            HasSubstr("d.vrt: is neither a picture nor an elevation model")));
}

}  // namespace
}  // namespace scipd::sim
