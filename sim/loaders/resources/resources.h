// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the models and meshes that a world names by URI. It looks, in this order,
//
//   1  in the folder of the file that names it and in the one above, with `models/` in both, and
//      for model:// and package:// in all folders above;
//      or below the package.xml in one of them that gives the package this name;
//   2  the same for the file that was asked for;
//   3  in the folders of SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH,
//      GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH, in their
//      share/ and, for packages in stacks, one folder further down; then below ROS_PACKAGE_PATH
//      by the names that package.xml gives;
//   4  in the folders that the caller adds;
//   5  for http and https, where Gazebo keeps what it has downloaded; its Sun and its Ground Plane
//      also as model://sun and model://ground_plane. Nothing is ever downloaded.
//
// A folder without a model.config is no model: the search goes on, and takes it only if there is no
// other. If no name matches exactly, a name that differs in case matches too.
//
// It remembers what it has found, and what it has not. One thread; the constructor reads the
// environment.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace scipd::sim {

/// A file that a world names.
struct NamedFile {
    std::string uri;
    std::filesystem::path folder;  ///< where a relative URI starts
};

class Resources {
  public:
    /// `folder` holds the file that the user asked for; `more` are the caller's folders.
    explicit Resources(std::filesystem::path folder, std::vector<std::filesystem::path> more = {});

    /// The file or folder that `uri` names in a file in the folder `beside`; empty if there is
    /// none.
    [[nodiscard]] std::filesystem::path find(const std::string& uri,
                                             const std::filesystem::path& beside) const;
    /// For messages: why find() found nothing, and what to do.
    [[nodiscard]] std::string not_found(const std::string& uri,
                                        const std::filesystem::path& beside) const;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    /// The way of comparing names, the folder that the search begins in, and the URI. No folder:
    /// along the search path.
    using Search = std::tuple<std::size_t, std::filesystem::path, std::string>;
    struct Found {
        std::filesystem::path path;
        std::filesystem::path bare;  ///< a folder that has the name and is no model
    };
    using Packages = std::map<std::string, std::filesystem::path>;

    [[nodiscard]] Found once(const Search& search) const;
    [[nodiscard]] Found search_for(const Search& search) const;
    [[nodiscard]] std::vector<std::filesystem::path> packages_called(
        const std::string& name, const std::filesystem::path& from) const;
    [[nodiscard]] const Packages& packages_below(const std::filesystem::path& folder,
                                                 int levels) const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> search_path_;
    std::vector<std::filesystem::path> package_path_;
    mutable std::map<Search, Found> known_;
    mutable std::map<std::pair<std::filesystem::path, int>, Packages> packages_;
};

/// The folders of those variables, and where downloads are kept: whoever starts this program has
/// named them.
std::vector<std::filesystem::path> resource_folders();

/// A shell command that downloads `uri`; empty if Gazebo would not download it. All files of a
/// model have the same command.
std::string download_command(const std::string& uri);

/// A warning if `found` and the name in `uri` differ in case; empty if they do not.
std::string case_warning(const std::string& uri, const std::filesystem::path& found);

}  // namespace scipd::sim
