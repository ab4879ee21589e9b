// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the things lie that a world names by URI: models and meshes. Looks, in this order,
//
//   1  in the folder of the file that names it and in the one above, with `models/` in both, and
//      for model:// and package:// in all folders above;
//   2  the same for the file that was asked for;
//   3  in the folders of SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH,
//      GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH, in their
//      share/ and, for packages in stacks, one folder further down;
//   4  in the folders that the caller adds;
//   5  for http and https, where Gazebo keeps what it has downloaded; its Sun and its Ground Plane
//      also as model://sun and model://ground_plane. Nothing is ever downloaded.
//
// Where it is nowhere as it is called, it may differ in capitals.
//
// What lies two folders down a ROS_PACKAGE_PATH is not found, nor what only a package.xml names.
// Any thread; the environment is read when it is made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scipd::sim {

class Resources {
  public:
    /// `folder` is that of the file that was asked for.
    explicit Resources(std::filesystem::path folder, std::vector<std::filesystem::path> more = {});

    /// The file or folder that `uri` names in a file in this folder; empty where there is none.
    [[nodiscard]] std::filesystem::path find(const std::string& uri,
                                             const std::filesystem::path& beside) const;
    /// For messages: why it was not found, and what to do.
    [[nodiscard]] std::string not_found(const std::string& uri,
                                        const std::filesystem::path& beside) const;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> search_path_;
};

/// For a shell; empty where Gazebo would not download it. The same for all files of a model.
std::string download_command(const std::string& uri);

/// Where what was found for a URI is called otherwise, but for the case; empty where it is not.
std::string case_warning(const std::string& uri, const std::filesystem::path& found);

}  // namespace scipd::sim
