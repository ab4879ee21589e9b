// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/resources/resources.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

/// Set while it lives.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* old = std::getenv(name)) before_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_.empty()) {
            unsetenv(name_);
        } else {
            setenv(name_, before_.c_str(), 1);
        }
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::string before_;
};

/// Folders above the temporary one are searched too, and so is the user's cache: models and
/// packages have a name that nothing else has.
class ResourcesTest : public ::testing::Test {
  protected:
    std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }
    std::string find(const std::string& uri) const {
        const auto found = Resources{at("world")}.find(uri, at("world"));
        return found.empty() ? "" : found.lexically_relative(folder_.path()).string();
    }
    tests::TempDir folder_;
    const std::string own_ = "own_" + folder_.path().filename().string();
    const Variable home_{"HOME", folder_.path().string()};
};

TEST_F(ResourcesTest, NearComesBeforeFar) {
    const std::string uri = "model://" + own_;
    const std::string file = "/" + own_ + "/model.sdf";
    folder_.write("far" + file, "");
    const Variable path{"GAZEBO_MODEL_PATH", "/nowhere::" + at("far").string()};
    EXPECT_EQ(find(uri), "far/" + own_);
    folder_.write("models" + file, "");
    EXPECT_EQ(find(uri), "models/" + own_);
    folder_.write("world/models" + file, "");
    EXPECT_EQ(find(uri), "world/models/" + own_);
    folder_.write("world" + file, "");
    EXPECT_EQ(find(uri), "world/" + own_);
    EXPECT_EQ(find(own_ + "/model.sdf"), "world" + file);
    EXPECT_EQ(find("file://" + at("far/" + own_).string()), "far/" + own_);
}

TEST_F(ResourcesTest, EveryVariableIsAsked) {
    folder_.write("far/" + own_ + "/model.sdf", "");
    EXPECT_EQ(find("model://" + own_), "");
    for (const char* name :
         {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
          "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
        const Variable path{name, at("far").string()};
        EXPECT_EQ(find("model://" + own_), "far/" + own_) << name;
    }
}

TEST_F(ResourcesTest, PackagesAreFoundInTheirFolderAndOneDown) {
    const std::string stack = own_ + "_stack";
    folder_.write("ws/" + own_ + "/m.stl", "");
    folder_.write("ws/deep/" + stack + "/" + own_ + "_low/m.stl", "");
    {
        const Variable path{"ROS_PACKAGE_PATH", at("ws/" + own_).string()};
        EXPECT_EQ(find("package://" + own_ + "/m.stl"), "ws/" + own_ + "/m.stl");
        EXPECT_EQ(find(own_ + "/m.stl"), "");
    }
    const Variable path{"ROS_PACKAGE_PATH", at("ws").string()};
    const std::string low = "/" + own_ + "_low/m.stl";
    EXPECT_EQ(find("package://" + stack + low), "ws/deep/" + stack + low);
    EXPECT_EQ(find("package:/" + low), "");
}

// Gazebo's search does the same: a folder that has the name of a model need not be one.
TEST_F(ResourcesTest, AFolderWithoutAModelConfigIsPassedByForAModel) {
    folder_.write("world/" + own_ + "/" + own_ + ".world", "");
    const std::string uri = "model://" + own_;
    EXPECT_EQ(find(uri), "world/" + own_);
    folder_.write("far/" + own_ + "/model.config", "");
    const Variable path{"GAZEBO_MODEL_PATH", at("far").string()};
    EXPECT_EQ(find(uri), "far/" + own_);
    EXPECT_EQ(find(uri + "/" + own_ + ".world"), "world/" + own_ + "/" + own_ + ".world");
    folder_.write("stacks/stack/" + own_ + "/a.sdf", "");
    const Variable stacks{"GAZEBO_MODEL_PATH", at("stacks").string() + ":" + at("far").string()};
    EXPECT_EQ(find(uri), "far/" + own_);
}

std::string package_xml(const std::string& name) {
    return "<package format='3'><name>" + name + "</name></package>";
}

TEST_F(ResourcesTest, PackagesAreFoundByTheNameInTheirPackageXml) {
    const std::string uri = "package://" + own_ + "/meshes/a.stl";
    folder_.write("ws/src/repository/a_folder/package.xml", package_xml(own_));
    folder_.write("ws/src/repository/a_folder/meshes/a.stl", "");
    EXPECT_EQ(find(uri), "");
    {
        const Variable path{"ROS_PACKAGE_PATH", at("ws").string()};
        EXPECT_EQ(find(uri), "ws/src/repository/a_folder/meshes/a.stl");
        EXPECT_EQ(find("package://" + own_ + "/meshes/b.stl"), "");
    }
    // Beside a package above the file, and above it.
    const auto from = [&](const std::string& folder) {
        const auto found = Resources{at(folder)}.find(uri, at(folder));
        return found.empty() ? "" : found.lexically_relative(folder_.path()).string();
    };
    EXPECT_EQ(from("ws/src/repository/another/urdf"), "ws/src/repository/a_folder/meshes/a.stl");
    EXPECT_EQ(from("ws/src/repository/a_folder/urdf/arm"),
              "ws/src/repository/a_folder/meshes/a.stl");
}

// Whatever appears later is not found: the first answer holds for all that a world names.
TEST_F(ResourcesTest, EachSearchIsMadeOnce) {
    const Variable path{"GAZEBO_MODEL_PATH", at("far").string()};
    const Resources resources{at("world")};
    const std::string uri = "model://" + own_;
    EXPECT_EQ(resources.find(uri, at("world")), "");
    folder_.write("far/" + own_ + "/model.config", "");
    EXPECT_EQ(resources.find(uri, at("world")), "");
    EXPECT_EQ(Resources{at("world")}.find(uri, at("world")), at("far/" + own_));
}

TEST_F(ResourcesTest, TheCallersFoldersComeLast) {
    folder_.write("more/" + own_ + "/model.sdf", "");
    EXPECT_EQ(Resources(at("world"), {at("more")}).find("model://" + own_, at("world")),
              at("more/" + own_));
}

TEST_F(ResourcesTest, WhatGazeboHasDownloadedIsFoundInItsCache) {
    const Variable cache{"GZ_FUEL_CACHE_PATH", at("cache").string()};
    const std::string host = "cache/fuel.gazebosim.org/openrobotics/models/big box/";
    folder_.write(host + "2/model.sdf", "");
    folder_.write(host + "10/model.sdf", "");
    folder_.write(host + "10/meshes/a.dae", "");
    folder_.write(host + "new/model.sdf", "");
    const std::string uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Big Box";
    EXPECT_EQ(find(uri), host + "10");
    EXPECT_EQ(find(uri + "/2"), host + "2");
    EXPECT_EQ(find(uri + "/tip/files/meshes/a.dae"), host + "10/meshes/a.dae");
    EXPECT_EQ(find(uri + "/3"), "");
    EXPECT_EQ(Resources{at("world")}.not_found("https://h/1.0/o/models/n", at("world")),
              "'https://h/1.0/o/models/n' has not been downloaded; fetch it with `gz fuel download "
              "-u 'https://h/1.0/o/models/n'`, or name a copy");
}

// To be pasted into a shell, whatever is in it; of a mesh, the model that has it.
TEST_F(ResourcesTest, WhatIsToBeDownloadedIsACommand) {
    const std::string model = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
    EXPECT_EQ(download_command(model + "Big Box"), "gz fuel download -u '" + model + "Big Box'");
    EXPECT_EQ(download_command(model + "it's"), "gz fuel download -u '" + model + "it'\\''s'");
    EXPECT_EQ(download_command(model + "Box/tip/files/meshes/a.dae"),
              "gz fuel download -u '" + model + "Box'");
    EXPECT_EQ(download_command(model + "Box/3/files/meshes/a.dae"),
              "gz fuel download -u '" + model + "Box/3'");
    EXPECT_EQ(download_command("model://box"), "");
}

TEST_F(ResourcesTest, NamesMayDifferInCase) {
    folder_.write("far/" + own_ + "/Meshes/Wall.DAE", "");
    const std::string there = "far/" + own_ + "/Meshes/Wall.DAE";
    const std::string uri = "model://" + own_ + "/meshes/wall.dae";
    const Variable path{"GAZEBO_MODEL_PATH", at("far").string()};
    EXPECT_EQ(find(uri), there);
    EXPECT_EQ(case_warning(uri, at(there)), "'" + uri + "' is called " + at(there).string() +
                                                " here; it is used, though the names differ in "
                                                "case");
    // What is there as it is called is nearer, wherever it is.
    folder_.write("more/" + own_ + "/meshes/wall.dae", "");
    EXPECT_EQ(Resources(at("world"), {at("more")}).find(uri, at("world")),
              at("more/" + own_ + "/meshes/wall.dae"));
    EXPECT_EQ(case_warning(uri, at("more/" + own_ + "/meshes/wall.dae")), "");
    EXPECT_EQ(find("file://" + at("FAR/" + own_ + "/meshes/wall.dae").string()), there);
}

TEST_F(ResourcesTest, TheSunAndTheGroundOfTheWebAreOurs) {
    folder_.write("more/sun/model.sdf", "");
    folder_.write("more/ground_plane/model.sdf", "");
    folder_.write("more/moon/model.sdf", "");
    const Resources resources{at("world"), {at("more")}};
    const auto found = [&](const std::string& name) {
        return resources.find("https://fuel.gazebosim.org/1.0/" + name, at("world"));
    };
    EXPECT_EQ(found("OpenRobotics/models/Sun"), at("more/sun"));
    EXPECT_EQ(found("openrobotics/models/Ground Plane"), at("more/ground_plane"));
    EXPECT_EQ(found("OpenRobotics/models/Ground%20Plane"), at("more/ground_plane"));
    EXPECT_EQ(found("OpenRobotics/models/Moon"), "");
    EXPECT_EQ(found("Somebody/models/Sun"), "");
    // What was downloaded is what Gazebo shows.
    const Variable cache{"GZ_FUEL_CACHE_PATH", at("cache").string()};
    const std::string downloaded = "cache/fuel.gazebosim.org/openrobotics/models/sun/1";
    folder_.write(downloaded + "/model.sdf", "");
    EXPECT_EQ(found("OpenRobotics/models/Sun"), at(downloaded));
}

TEST_F(ResourcesTest, BlanksMayBeSpelledInEitherWay) {
    const Variable cache{"GZ_FUEL_CACHE_PATH", at("cache").string()};
    const std::string host = "cache/fuel.gazebosim.org/openrobotics/models/";
    folder_.write(host + "big box/1/meshes/a part.dae", "");
    folder_.write(host + "small%20box/1/meshes/a%20part.dae", "");
    const std::string uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
    for (const std::string blank : {" ", "%20"}) {
        const std::string file = "Box/1/files/meshes/a" + blank + "part.dae";
        EXPECT_EQ(find(uri + "Big" + blank + file), host + "big box/1/meshes/a part.dae");
        EXPECT_EQ(find(uri + "Small" + blank + file), host + "small%20box/1/meshes/a%20part.dae");
    }
    const std::string with_blank = own_ + " b/meshes/a wall.dae";
    const std::string without = own_ + "%20c/meshes/a%20wall.dae";
    folder_.write("models/" + with_blank, "");
    folder_.write("models/" + without, "");
    EXPECT_EQ(find("model://" + own_ + "%20b/meshes/a%20wall.dae"), "models/" + with_blank);
    EXPECT_EQ(find("model://" + own_ + " c/meshes/a wall.dae"), "models/" + without);
    EXPECT_EQ(find("model://" + own_ + " d/meshes/a wall.dae"), "");
}

TEST_F(ResourcesTest, NothingIsNowhere) {
    for (const char* uri : {"", "model://", "https://", "https://a/b", "://"})
        EXPECT_EQ(find(uri), "") << uri;
}

}  // namespace
}  // namespace scipd::sim
