// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_document.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, MapMode>, 3> modes{
    {{"trinary", MapMode::trinary}, {"scale", MapMode::scale}, {"raw", MapMode::raw}}};

/// Finds the picture as map_server does.
Expected<fs::path> image_path(const YAML::Node& node, const fs::path& folder) {
    const std::string text = node.IsScalar() ? node.Scalar() : std::string();
    if (text.empty() || text.find('\0') != text.npos) return refuse("must name a picture");
    const char* home = std::getenv("HOME");
    if (text.starts_with("~/") && home != nullptr) return fs::path{home} / text.substr(2);
    return folder / text;
}

Expected<double> number(const YAML::Node& node, double low, double high, const char* otherwise) {
    double value = 0.0;
    const bool is_number = node.IsScalar() && YAML::convert<double>::decode(node, value);
    if (!is_number || !(value >= low && value <= high)) return refuse(otherwise);
    return value;
}

Expected<double> threshold(const YAML::Node& node) {
    return number(node, 0.0, 1.0, "must be a number within 0 and 1");
}

Expected<double> resolution_m(const YAML::Node& node) {
    return number(node, 1e-4, 1e3, "must be within 0.0001 and 1000 m a pixel");
}

struct Origin {
    glm::dvec2 xy_m;
    double yaw_rad;
};

Expected<Origin> origin_of(const YAML::Node& node) {
    if (!node.IsSequence() || node.size() != 3) return refuse("must be [x, y, yaw]");
    const char* const too_far = "x and y must be metres within 1e7";
    const auto x_m = number(node[0], -position_limit_m, position_limit_m, too_far);
    if (!x_m) return tl::unexpected(x_m.error());
    const auto y_m = number(node[1], -position_limit_m, position_limit_m, too_far);
    if (!y_m) return tl::unexpected(y_m.error());
    const auto yaw_rad = number(node[2], -1e3, 1e3, "yaw must be an angle in radians");
    if (!yaw_rad) return tl::unexpected(yaw_rad.error());
    return Origin{{*x_m, *y_m}, *yaw_rad};
}

/// Takes any integer, where all but 0 are true as in C, or a word of YAML's for yes or no.
Expected<bool> truth(const YAML::Node& node) {
    int value = 0;
    bool word = false;
    if (node.IsScalar() && YAML::convert<int>::decode(node, value)) return value != 0;
    if (node.IsScalar() && YAML::convert<bool>::decode(node, word)) return word;
    return refuse("must be 0 or 1");
}

/// Ignores case, since people write it either way.
Expected<MapMode> mode_of(const YAML::Node& node) {
    std::string text = node.IsScalar() ? node.Scalar() : std::string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const auto& [name, mode] : modes) {
        if (text == name) return mode;
    }
    return refuse("must be trinary, scale or raw");
}

/// Other files of YAML that people keep near their maps, by a key that tells each.
constexpr std::array<std::pair<const char*, const char*>, 3> other_yamls{
    {{"layers", "a world of Flatland, which is not read; name the map of one of its layers"},
     {"levels",
      "a building of Open-RMF, which is not read; name the world that building_map_generator makes "
      "of it"},
     {"robots", "a configuration of scipd; name it with --config"}}};

/// Empty if the document has anything that a map has.
std::string why_no_map(const YAML::Node& document) {
    const std::string no_map = "is no map of map_server, which has keys such as `image: hall.pgm`";
    if (!document.IsMap()) return no_map;
    const auto has = [&](const char* key) { return document[key].IsDefined(); };
    if (has("image") || has("resolution") || has("origin")) return {};
    for (const auto& [key, what] : other_yamls) {
        if (has(key)) return std::string{"is no map; it looks like "} + what;
    }
    if (document.size() == 0) return no_map;
    const YAML::Node first = document.begin()->first;
    return no_map + (first.IsScalar() ? "; it begins with " + quote(first.Scalar()) : "");
}

/// Reads key by key. After a fault it goes on with the next key, so as to report all of them.
class MapFileReader {
  public:
    MapFileReader(const YAML::Node& document, const fs::path& file, YamlFaults& faults)
        : document_{.value = document}, file_(file), faults_(faults) {}

    MapFile read() &&;

  private:
    /// False if there is no such key.
    template <typename Read, typename Value>
    bool take(const char* key, const Read& read, Value& target);
    template <typename Read, typename Value>
    void want(const char* key, const Read& read, Value& target);
    void read_thresholds();

    const YamlField document_;
    fs::path file_;
    YamlFaults& faults_;
    MapFile map_;
};

template <typename Read, typename Value>
bool MapFileReader::take(const char* key, const Read& read, Value& target) {
    const auto field = entry_of(document_, key);
    if (field) faults_.take(*field, read(field->value), target);
    return field.has_value();
}

template <typename Read, typename Value>
void MapFileReader::want(const char* key, const Read& read, Value& target) {
    if (!take(key, read, target)) faults_.add(1, key, "is missing; every map has one");
}

void MapFileReader::read_thresholds() {
    const auto read = [&](const char* key, double& target, const char* taken) {
        if (take(key, threshold, target)) return;
        map_.warnings.push_back(file_.string() + ": has no " + key + "; " + taken +
                                " is taken, as ROS 1 saves it");
    };
    read("occupied_thresh", map_.occupied_above, "0.65");
    read("free_thresh", map_.free_below, "0.196");
    if (faults_.count() > 0 || map_.free_below <= map_.occupied_above) return;
    const auto given = entry_of(document_, "free_thresh");
    faults_.add(given ? given->line : 1, "free_thresh", "must not be above occupied_thresh");
}

MapFile MapFileReader::read() && {
    if (const std::string why = why_no_map(document_.value); !why.empty()) {
        faults_.add(1, {}, why);
        faults_.throw_if_any();
    }
    const auto image = [&](const YAML::Node& node) {
        return image_path(node, file_.parent_path());
    };
    Origin origin{map_.origin_m, map_.yaw_rad};
    want("image", image, map_.image);
    want("resolution", resolution_m, map_.resolution_m);
    want("origin", origin_of, origin);
    take("mode", mode_of, map_.mode);
    want("negate", truth, map_.negate);
    map_.origin_m = origin.xy_m;
    map_.yaw_rad = origin.yaw_rad;
    read_thresholds();
    faults_.throw_if_any();
    return std::move(map_);
}

}  // namespace

MapFile parse_map_file(const std::string& text, const fs::path& file) {
    YamlFaults faults{file.string()};
    return MapFileReader{parse_yaml(text, "a map", faults), file, faults}.read();
}

}  // namespace scipd::sim
