// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "daemon/config/config_file.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/yaml/yaml_section.h"
#include "sim/text/near_word.h"
#include "sim/text/text_number.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;
using std::string_view_literals::operator""sv;

constexpr std::size_t largest_yaml = 1 << 20;
constexpr std::array world_extensions{".sdf"sv,  ".world"sv, ".model"sv,
                                      ".urdf"sv, ".xacro"sv, ".xml"sv};

/// The keys of a document, as far as it is a map.
class Keys {
  public:
    explicit Keys(const YAML::Node& document) {
        for (const auto& entry : document) {
            if (!entry.first.IsScalar()) continue;
            names_.push_back(entry.first.Scalar());
            if (entry.second.IsMap()) maps_.push_back(names_.back());
        }
    }

    [[nodiscard]] bool have(std::string_view key) const {
        return std::ranges::find(names_, key) != names_.end();
    }
    [[nodiscard]] bool have_map(std::string_view key) const {
        return std::ranges::find(maps_, key) != maps_.end();
    }
    /// One of these, or something that could be meant as one.
    [[nodiscard]] bool have_near(std::span<const std::string_view> keys) const {
        return std::ranges::any_of(
            names_, [&](const std::string& name) { return sim::meant(name, keys).has_value(); });
    }

  private:
    std::vector<std::string> names_;
    std::vector<std::string> maps_;
};

std::optional<FileKind> kind_of_yaml(const YAML::Node& document) {
    if (!document.IsMap()) return std::nullopt;
    if (document.size() == 0) return FileKind::configuration;
    const Keys keys(document);
    if (keys.have("robots")) return FileKind::configuration;
    if (keys.have("steps")) return FileKind::scenario;
    if (keys.have_map("materials")) return FileKind::materials;
    if (keys.have("image") || keys.have("occupied_thresh")) return FileKind::map;
    // Worlds of others. Who reads maps says what they are.
    if (keys.have("layers") || keys.have("levels")) return FileKind::map;
    if (keys.have_near(configuration_keys())) return FileKind::configuration;
    constexpr std::array scenario{"steps"sv};
    constexpr std::array materials{"materials"sv};
    constexpr std::array map{"image"sv, "resolution"sv, "occupied_thresh"sv, "free_thresh"sv};
    if (keys.have_near(scenario)) return FileKind::scenario;
    if (keys.have_near(materials)) return FileKind::materials;
    return keys.have_near(map) ? std::optional(FileKind::map) : std::nullopt;
}

/// Nothing where the text is no YAML.
std::optional<YAML::Node> yaml_in(const std::string& text) {
    sim::YamlFaults faults{""};
    try {
        return sim::parse_yaml(text, "anything", faults);
    } catch (const sim::LoadError&) {
        return std::nullopt;
    }
}

/// Whether the first line that says something is of numbers, or names the columns of some.
bool is_trajectory(std::string_view text) {
    std::string_view before;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (sim::says_nothing(line)) continue;
        const std::string_view said = sim::trimmed(line);
        const std::string_view first = said.substr(0, said.find_first_of(" \t,;"));
        if (first.size() < said.size() && sim::parse_number(first)) return true;
        if (!before.empty()) return false;
        before = said;
    }
    return false;
}

/// Tells the kind by the text, for a file whose extension says nothing.
std::optional<FileKind> kind_of_text(const fs::path& file) {
    const std::string beginning = sim::beginning_of(file);
    if (beginning.find('\0') != beginning.npos) return std::nullopt;
    std::error_code error;
    if (fs::file_size(file, error) <= largest_yaml) {
        const auto document = yaml_in(sim::read_file(file, largest_yaml, ""));
        if (document && document->IsMap() && document->size() > 0) return kind_of_yaml(*document);
    }
    return is_trajectory(beginning) ? std::optional(FileKind::trajectory) : std::nullopt;
}

std::optional<FileKind> kind_of_plain(const fs::path& file) {
    const std::string extension = sim::extension_of(file);
    if (std::ranges::find(world_extensions, extension) != world_extensions.end())
        return FileKind::world;
    if (sim::is_mesh_file(file)) return FileKind::mesh;
    if (extension == ".tum" || extension == ".csv") return FileKind::trajectory;
    if (extension != ".yaml" && extension != ".yml") return kind_of_text(file);
    std::error_code error;
    const bool is_large = fs::file_size(file, error) > largest_yaml;
    const auto document = is_large ? std::nullopt : yaml_in(sim::read_file(file, largest_yaml, ""));
    // Who reads a configuration says what is wrong with the YAML.
    return document ? kind_of_yaml(*document) : FileKind::configuration;
}

}  // namespace

sim::Expected<FileKind> kind_of(const fs::path& file) {
    std::error_code error;
    if (fs::is_directory(file, error)) return FileKind::world;
    if (const auto plain = sim::check_plain_file(file); !plain)
        return tl::unexpected(plain.error());
    try {
        if (const auto kind = kind_of_plain(file)) return *kind;
    } catch (const std::runtime_error& why) {
        return sim::refuse(why.what());
    }
    return sim::refuse(
        "is not a file type that scipd knows. Known are: a configuration, a scenario, materials "
        "or a ROS map "
        "(.yaml), a world (.sdf, .world, .model, .urdf, .xacro, .xml, or the folder of a "
        "model), a mesh (.obj, .stl, .ply, .dae, .gltf, .glb), or a trajectory (TUM, EuRoC, "
        "KITTI, or CSV with a header)");
}

}  // namespace scipd::daemon
