// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/recording_files.h"

#include <algorithm>
#include <array>

#include <yaml-cpp/yaml.h>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> endings{".mcap", ".db3", ".bag", ".active"};
constexpr const char* metadata_name = "metadata.yaml";
/// rosbag2 writes some kB for each topic and file.
constexpr std::uintmax_t largest_metadata = std::uintmax_t{16} << 20;

std::string shown_path(const fs::path& path) {
    return printable(path.string(), whole_path);
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_bag(fs::path path) {
    if (path.extension() == ".zstd" || path.extension() == ".zst") path = path.stem();
    const std::string ending = path.extension().string();
    return std::ranges::find(endings, ending) != endings.end();
}

/// The names in the order of rosbag2, without folders: old versions begin with that of the bag.
/// Empty where a recorder was killed and left none.
std::vector<fs::path> names_by_metadata(const fs::path& metadata) {
    std::vector<fs::path> names;
    std::error_code error;
    if (!is_file(metadata) || fs::file_size(metadata, error) > largest_metadata) return names;
    try {
        const YAML::Node document = YAML::LoadFile(metadata.string());
        const YAML::Node about = document["rosbag2_bagfile_information"];
        for (const YAML::Node& name : about["relative_file_paths"])
            names.push_back(fs::path(name.as<std::string>()).filename());
    } catch (const YAML::Exception&) {
        names.clear();
    }
    return names;
}

/// The file, or as it is named once it has been packed.
RecordingFile file_in(const fs::path& folder, const fs::path& name) {
    for (const char* const packed : {"", ".zstd", ".zst"}) {
        const fs::path path = (folder / name).string() + packed;
        if (is_file(path)) return {path, false, {}};
    }
    return {
        folder / name, false,
        shown_path(folder / name) + ": there is no such file, but " + metadata_name + " names it"};
}

Expected<std::vector<RecordingFile>> files_in(const fs::path& folder) {
    std::vector<fs::path> names = names_by_metadata(folder / metadata_name);
    if (names.empty()) {
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end;) {
            if (is_bag(entry->path())) names.push_back(entry->path().filename());
            entry.increment(error);
        }
        if (error) return refuse(shown_path(folder) + ": cannot be read: " + error.message());
        std::ranges::sort(names);
    }
    if (names.empty())
        return refuse(shown_path(folder) +
                      ": is a folder without a bag (.mcap, .db3, .bag); name a recording");
    std::vector<RecordingFile> files;
    for (const fs::path& name : names)
        files.push_back(file_in(folder, name));
    return files;
}

}  // namespace

Expected<std::vector<RecordingFile>> files_of(std::span<const fs::path> paths) {
    std::vector<RecordingFile> files;
    for (const fs::path& path : paths) {
        std::error_code ignored;
        if (!fs::is_directory(path, ignored)) {
            files.push_back({path, true, {}});
            continue;
        }
        auto inside = files_in(path);
        if (!inside) return tl::unexpected(inside.error());
        files.insert(files.end(), inside->begin(), inside->end());
    }
    return files;
}

std::vector<fs::path> split_paths(std::string_view text) {
    std::error_code ignored;
    std::vector<fs::path> paths;
    std::size_t begin = 0;
    for (std::size_t plus = text.find('+');
         plus != text.npos && !fs::exists(text.substr(begin), ignored);
         plus = text.find('+', plus + 1)) {
        const std::string_view name = text.substr(begin, plus - begin);
        if (!fs::exists(name, ignored)) continue;
        paths.emplace_back(name);
        begin = plus + 1;
    }
    // Without a file before a plus sign, it is a name like any other.
    paths.emplace_back(text.substr(begin));
    return paths;
}

}  // namespace scipd::sim
