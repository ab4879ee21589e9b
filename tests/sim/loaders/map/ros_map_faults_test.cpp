// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What load_ros_map() says about maps that it cannot use, and that it says so before it allocates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/map/ros_map.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/map/map_folder.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The header of a JPEG of four colours, of 1 x 1 pixel. Adobe's mark tells whether they are CMYK
/// (0) or YCCK (2), which is as good.
std::string jpeg_of_four_colours(char transform) {
    std::string frame{"\xFF\xC0\0\x14\x08\0\1\0\1\4", 10};
    std::string scan{"\xFF\xDA\0\x0E\4", 5};
    for (const char colour : {'\1', '\2', '\3', '\4'}) {
        frame += {colour, '\x11', '\0'};
        scan += {colour, '\0'};
    }
    const std::string adobe =
        std::string{
            "\xFF\xEE\0\x0E"
            "Adobe\0\x64\0\0\0\0",
            15} +
        transform;
    return "\xFF\xD8" + adobe + frame + scan + std::string{"\0\x3F\0\xFF\xD9", 5};
}

class RosMapFaults : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& text) {
        const auto file = folder_.write("a.yaml", text);
        return faults_of([&] { load_ros_map(file); }, folder_);
    }

    /// The faults of a sound YAML with this picture.
    std::vector<std::string> picture_faults(const std::string& picture) {
        folder_.write("a.pgm", picture);
        return faults(yaml("a.pgm"));
    }

    TempDir folder_;
};

TEST_F(RosMapFaults, everyFaultOfTheYamlAtOnceWithItsLine) {
    EXPECT_THAT(faults("resolution: 0\n"
                       "origin: [1, .nan, 0]\n"
                       "negate: perhaps\n"
                       "occupied_thresh: 65\n"
                       "free_thresh: [0]\n"
                       "mode: colour\n"),
                ElementsAre("a.yaml:1: image: is missing; every map has one",
                            "a.yaml:1: resolution: must be within 0.0001 and 1000 m a pixel",
                            "a.yaml:2: origin: x and y must be metres within 1e7",
                            "a.yaml:3: negate: must be 0 or 1",
                            "a.yaml:4: occupied_thresh: must be a number within 0 and 1",
                            "a.yaml:5: free_thresh: must be a number within 0 and 1",
                            "a.yaml:6: mode: must be trinary, scale or raw"));
    EXPECT_THAT(faults(yaml("[]", "mode: raw\n")),
                ElementsAre("a.yaml:1: image: must name a picture"));
    EXPECT_THAT(faults("image: a.pgm\nresolution: 1\norigin: [0, 0]\nnegate: 0\n"),
                ElementsAre("a.yaml:3: origin: must be [x, y, yaw]"));
    EXPECT_THAT(faults(yaml("a.pgm", "occupied_thresh: 0.2\nfree_thresh: 0.3\n")),
                ElementsAre("a.yaml:6: free_thresh: must not be above occupied_thresh"));
}

TEST_F(RosMapFaults, whatIsNoMap) {
    EXPECT_THAT(faults(""), ElementsAre("a.yaml:1: is no map of map_server, which has keys such "
                                        "as `image: hall.pgm`"));
    EXPECT_THAT(faults("- 1\n- 2\n"), ElementsAre(HasSubstr("a.yaml:1: is no map of map_server")));
    EXPECT_THAT(faults("a: b\n c: d\n"), ElementsAre(HasSubstr("a.yaml:2: not YAML: ")));
    EXPECT_THAT(faults(std::string(2 << 20, ' ')),
                ElementsAre("a.yaml: is larger than 1 MiB; name the YAML of a ROS map"));
    EXPECT_THAT(faults_of([&] { load_ros_map(folder_.path() / "b.yaml"); }, folder_),
                ElementsAre("b.yaml: no such file; name the YAML of a ROS map"));
    EXPECT_THAT(faults_of([&] { load_ros_map(folder_.path()); }, folder_),
                ElementsAre(HasSubstr("is a directory; name the YAML of a ROS map")));
    EXPECT_THAT(faults(yaml("none.pgm")),
                ElementsAre("none.pgm: no such file; the map's picture is wanted here"));
}

// Such a world is as good as an empty one, to which things are added.
TEST_F(RosMapFaults, aMapWithoutWallsIsAWarning) {
    folder_.write("a.pgm", pgm(2, {254, 254, 205, 254}));
    const auto loaded = load_ros_map(folder_.write("a.yaml", yaml("a.pgm")));
    EXPECT_THAT(loaded.scene->objects, IsEmpty());
    EXPECT_THAT(without_folder(loaded.warnings, folder_),
                ElementsAre("a.pgm: holds no wall that a scanner could see: no cell is above the "
                            "occupied_thresh of a.yaml"));
}

TEST_F(RosMapFaults, anotherYamlIsCalledByItsName) {
    EXPECT_THAT(faults("properties:\n  velocity_iterations: 10\nlayers:\n- name: 2d\n"
                       "  map: hall.yaml\n"),
                ElementsAre("a.yaml:1: is no map; it looks like a world of Flatland, which is not "
                            "read; name the map of one of its layers"));
    EXPECT_THAT(faults("name: clinic\nlevels:\n  L1:\n    doors: []\n"),
                ElementsAre("a.yaml:1: is no map; it looks like a building of Open-RMF, which is "
                            "not read; name the world that building_map_generator makes of it"));
    EXPECT_THAT(faults("scene: hall.sdf\nrobots: {}\n"),
                ElementsAre("a.yaml:1: is no map; it looks like a configuration of scipd; name it "
                            "with --config"));
    EXPECT_THAT(faults("/**:\n  ros__parameters: {}\n"),
                ElementsAre("a.yaml:1: is no map of map_server, which has keys such as `image: "
                            "hall.pgm`; it begins with '/**'"));
    EXPECT_THAT(faults("{}"), ElementsAre("a.yaml:1: is no map of map_server, which has keys such "
                                          "as `image: hall.pgm`"));
    // A map all the same, as far as it goes.
    EXPECT_THAT(faults("resolution: 1\norigin: [0, 0, 0]\nlayers: []\n"),
                ElementsAre("a.yaml:1: image: is missing; every map has one",
                            "a.yaml:1: negate: is missing; every map has one"));
}

TEST_F(RosMapFaults, aMapThatIsTooLarge) {
    folder_.write("a.pgm", "P5 20000 1 255\n" + std::string(20'000, '\0'));
    const std::string rest = "\norigin: [0, 0, 0]\nnegate: 0\n";
    EXPECT_THAT(faults("image: a.pgm\nresolution: 600" + rest),
                ElementsAre("a.pgm: is more than 1e7 m long at the resolution that the map says"));
    EXPECT_THAT(faults("image: a.pgm\nresolution: 400" + rest), IsEmpty());
}

TEST_F(RosMapFaults, brokenPictures) {
    EXPECT_THAT(
        picture_faults("GIF89a"),
        ElementsAre("a.pgm: is no PGM, PNG, BMP, JPEG or TIFF; save the map as one of these"));
    EXPECT_THAT(picture_faults("version https://git-lfs.github.com/spec/v1\noid sha256:1\n"),
                ElementsAre("a.pgm: is a pointer of Git LFS, no picture; fetch the file itself "
                            "with `git lfs pull`"));
    EXPECT_THAT(picture_faults("P5 2"),
                ElementsAre("a.pgm: is a broken PGM: the height is missing"));
    EXPECT_THAT(picture_faults("P5 2 2 0\n1234"),
                ElementsAre("a.pgm: is a broken PGM: maxval must be within 1 and 65535"));
    EXPECT_THAT(picture_faults("P5 2 2 255\n123"),
                ElementsAre("a.pgm: is a broken PGM: it ends 1 bytes too early"));
    EXPECT_THAT(picture_faults("P5 2 2 256\n1234567"),
                ElementsAre("a.pgm: is a broken PGM: it ends 1 bytes too early"));
    EXPECT_THAT(picture_faults("P2 2 1 255 12 x"),
                ElementsAre("a.pgm: is a broken PGM: a pixel is missing"));
    EXPECT_THAT(picture_faults("P5 0 2 255\n"), ElementsAre("a.pgm: has no pixels"));
    const std::string whole = png(2, 1, {0, 1, 2, 3});
    EXPECT_THAT(picture_faults(whole.substr(0, whole.size() / 2)),
                ElementsAre(HasSubstr("a.pgm: is a broken PNG: ")));
    EXPECT_THAT(picture_faults(odd_png(2, 2, 8, 0, "12345")),
                ElementsAre(HasSubstr("a.pgm: is a broken PNG: ")));
    EXPECT_THAT(picture_faults("\x89PNG"), ElementsAre(HasSubstr("a.pgm: is a broken PNG")));
}

// The library would take zeros for what is missing: walls.
TEST_F(RosMapFaults, picturesThatEndEarly) {
    const std::string map = bmp(3, 2, {0, 255, 0, 255, 0, 255});
    EXPECT_THAT(picture_faults(map), IsEmpty());
    EXPECT_THAT(picture_faults(map.substr(0, map.size() - 5)),
                ElementsAre("a.pgm: is a broken BMP: it ends 2 bytes too early"));
    EXPECT_THAT(picture_faults("BM"),
                ElementsAre("a.pgm: is a broken BMP: it ends within its header"));
    const std::string photo = jpeg(16, std::vector<int>(256, 0));
    EXPECT_THAT(picture_faults(photo), IsEmpty());
    EXPECT_THAT(picture_faults(photo.substr(0, photo.size() - 2)),
                ElementsAre(HasSubstr("a.pgm: is a broken JPEG: ")));
    EXPECT_THAT(picture_faults(photo.substr(0, photo.size() / 2)),
                ElementsAre(HasSubstr("a.pgm: is a broken JPEG: ")));
}

TEST_F(RosMapFaults, brokenTiffs) {
    const std::string whole = tiff(3, 1, {0, 255, 0, 255, 0, 255}, {{262, 1}});
    EXPECT_THAT(picture_faults(whole), IsEmpty());
    for (const std::size_t size : {4U, 12U, 40U})
        EXPECT_THAT(picture_faults(whole.substr(0, size)),
                    ElementsAre(HasSubstr("a.pgm: is a broken TIFF")))
            << size;
    EXPECT_THAT(picture_faults(tiff(3, 1, {0, 255, 0}, {{262, 1}, {256, 0}})),
                ElementsAre(HasSubstr("a.pgm: is a broken TIFF: ")));
    // 65000 x 2 pixels of which three are there, and samples of 64 bits.
    EXPECT_THAT(picture_faults(tiff(3, 1, {0, 255, 0, 0, 255, 0}, {{262, 1}, {256, 65000}})),
                ElementsAre(HasSubstr("a.pgm: is a broken TIFF: ")));
    EXPECT_THAT(picture_faults(tiff(3, 1, {0, 255, 0}, {{262, 1}, {258, 64}})),
                ElementsAre(AllOf(HasSubstr("a.pgm: is a TIFF that cannot be read ("),
                                  HasSubstr("save it in 8-bit grey"))));
}

TEST_F(RosMapFaults, aJpegInTheColoursOfAPrinter) {
    for (const char transform : {'\0', '\2'}) {
        EXPECT_THAT(picture_faults(jpeg_of_four_colours(transform)),
                    ElementsAre("a.pgm: is a JPEG in CMYK, the colours of a printer; save it in "
                                "grey or RGB"));
    }
}

TEST_F(RosMapFaults, aBmpOfRunLengths) {
    std::string map = bmp(3, 2, {0, 255, 0, 255, 0, 255});
    map[30] = 1;
    EXPECT_THAT(picture_faults(map),
                ElementsAre("a.pgm: is a BMP of run lengths; save it without compression"));
}

TEST_F(RosMapFaults, picturesThatAreTooLargeByTheirHeader) {
    const auto too_many = "a.pgm: has 100000 x 100000 pixels; a map has at most 100 million";
    EXPECT_THAT(picture_faults("P5 100000 100000 255\n"), ElementsAre(too_many));
    EXPECT_THAT(picture_faults("P2 100000 100000 255\n"), ElementsAre(too_many));
    // stb_image has a limit of its own here, past which it calls a picture corrupt.
    EXPECT_THAT(picture_faults(odd_png(20000, 20000, 8, 0, "")),
                ElementsAre("a.pgm: has 20000 x 20000 pixels; a map has at most 100 million"));
    EXPECT_THAT(picture_faults(odd_png(100'000, 100'000, 8, 0, "")),
                ElementsAre(HasSubstr("a.pgm: is a broken PNG: ")));
    EXPECT_THAT(picture_faults(odd_png(9000, 9000, 16, 6, "")),
                ElementsAre("a.pgm: takes more than 512 MiB; save it in 8-bit grey"));
    std::string map = bmp(3, 2, {0, 255, 0, 255, 0, 255});
    map.replace(20, 2, "\x01\x10");  // a width of 0x10010003
    EXPECT_THAT(picture_faults(map),
                ElementsAre("a.pgm: has 268500995 x 2 pixels; a map has at most 100 million"));
    std::string photo = jpeg(16, std::vector<int>(256, 0));
    photo.replace(photo.find("\xFF\xC0") + 5, 4, std::string{'\x80', 0, '\x80', 0});
    EXPECT_THAT(picture_faults(photo),
                ElementsAre("a.pgm: has 32768 x 32768 pixels; a map has at most 100 million"));
    // Within the limits, but the file ends long before.
    EXPECT_THAT(picture_faults("P5 9999 9999 255\n"), ElementsAre(HasSubstr("too early")));
    EXPECT_THAT(picture_faults("P2 9999 9999 255\n"), ElementsAre(HasSubstr("too early")));
}

TEST_F(RosMapFaults, aPngThatHoldsMoreThanItsHeaderSays) {
    // Two pixels, and 2 MiB of rows that deflate to 2 KiB.
    EXPECT_THAT(picture_faults(odd_png(2, 1, 8, 0, std::string(2 << 20, '\0'))),
                ElementsAre("a.pgm: is a broken PNG: it holds more than its header says"));
}

}  // namespace
}  // namespace scipd::sim
