// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/resources.h"

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

class ResourcesTest : public ::testing::Test {
  protected:
    std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }
    std::string find(const std::string& uri) const {
        const auto found = Resources{at("world")}.find(uri, at("world"));
        return found.empty() ? "" : found.lexically_relative(folder_.path()).string();
    }
    tests::TempDir folder_;
};

TEST_F(ResourcesTest, NearComesBeforeFar) {
    folder_.write("far/a/model.sdf", "");
    const Variable path{"GAZEBO_MODEL_PATH", "/nowhere::" + at("far").string()};
    EXPECT_EQ(find("model://a"), "far/a");
    folder_.write("models/a/model.sdf", "");
    EXPECT_EQ(find("model://a"), "models/a");
    folder_.write("world/models/a/model.sdf", "");
    EXPECT_EQ(find("model://a"), "world/models/a");
    folder_.write("world/a/model.sdf", "");
    EXPECT_EQ(find("model://a"), "world/a");
    EXPECT_EQ(find("a/model.sdf"), "world/a/model.sdf");
    EXPECT_EQ(find("file://" + at("far/a").string()), "far/a");
}

TEST_F(ResourcesTest, EveryVariableIsAsked) {
    folder_.write("far/a/model.sdf", "");
    EXPECT_EQ(find("model://a"), "");
    for (const char* name :
         {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
          "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
        const Variable path{name, at("far").string()};
        EXPECT_EQ(find("model://a"), "far/a") << name;
    }
}

TEST_F(ResourcesTest, PackagesAreFoundInTheirFolderAndOneDown) {
    folder_.write("ws/pkg/m.stl", "");
    folder_.write("ws/deep/stack/low/m.stl", "");
    {
        const Variable path{"ROS_PACKAGE_PATH", at("ws/pkg").string()};
        EXPECT_EQ(find("package://pkg/m.stl"), "ws/pkg/m.stl");
        EXPECT_EQ(find("pkg/m.stl"), "");
    }
    const Variable path{"ROS_PACKAGE_PATH", at("ws").string()};
    EXPECT_EQ(find("package://stack/low/m.stl"), "ws/deep/stack/low/m.stl");
    EXPECT_EQ(find("package://low/m.stl"), "");
}

TEST_F(ResourcesTest, TheCallersFoldersComeLast) {
    folder_.write("own/sun/model.sdf", "");
    EXPECT_EQ(Resources(at("world"), {at("own")}).find("model://sun", at("world")), at("own/sun"));
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
              "-u https://h/1.0/o/models/n`, or name a copy");
}

TEST_F(ResourcesTest, NothingIsNowhere) {
    for (const char* uri : {"", "model://", "https://", "https://a/b", "://"})
        EXPECT_EQ(find(uri), "") << uri;
}

}  // namespace
}  // namespace scipd::sim
