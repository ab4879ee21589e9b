// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, MapMode>, 3> modes{
    {{"trinary", MapMode::trinary}, {"scale", MapMode::scale}, {"raw", MapMode::raw}}};

/// Finds the picture as map_server does.
fs::path image_path(const std::string& text, const fs::path& folder) {
    if (text.empty() || text.find('\0') != text.npos) {
        throw std::invalid_argument("must name a picture");
    }
    const char* home = std::getenv("HOME");
    if (text.starts_with("~/") && home != nullptr) return fs::path{home} / text.substr(2);
    return folder / text;
}

double number(const YAML::Node& node, double low, double high, const char* otherwise) {
    double value = 0.0;
    const bool is_number = node.IsScalar() && YAML::convert<double>::decode(node, value);
    if (!is_number || !(value >= low && value <= high)) throw std::invalid_argument(otherwise);
    return value;
}

double threshold(const YAML::Node& node) {
    return number(node, 0.0, 1.0, "must be a number within 0 and 1");
}

/// Takes any integer, where all but 0 are true as in C, or a word of YAML's for yes or no.
bool truth(const YAML::Node& node) {
    int value = 0;
    bool word = false;
    if (node.IsScalar() && YAML::convert<int>::decode(node, value)) return value != 0;
    if (node.IsScalar() && YAML::convert<bool>::decode(node, word)) return word;
    throw std::invalid_argument("must be 0 or 1");
}

/// Ignores case, since people write it either way.
MapMode mode_of(const YAML::Node& node) {
    std::string text = node.IsScalar() ? node.Scalar() : std::string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const auto& [name, mode] : modes) {
        if (text == name) return mode;
    }
    throw std::invalid_argument("must be trinary, scale or raw");
}

/// Reads key by key. After a fault it goes on with the next key, so as to report all of them.
class MapFileReader {
  public:
    MapFileReader(const YAML::Node& document, const fs::path& file)
        : document_(document), file_(file) {}

    MapFile read() &&;

  private:
    template <typename Use>
    bool use(const char* key, const Use& apply);
    void want(const char* key, bool found);
    void read_origin();
    void read_thresholds();
    void add_fault(int line, const std::string& text) {
        faults_.push_back(file_.string() + ':' + std::to_string(line) + ": " + text);
    }

    const YAML::Node document_;
    fs::path file_;
    MapFile map_;
    std::vector<std::string> faults_;
};

/// False if there is no such key.
template <typename Use>
bool MapFileReader::use(const char* key, const Use& apply) {
    const YAML::Node node = document_[key];
    if (!node.IsDefined()) return false;
    try {
        apply(node);
    } catch (const std::invalid_argument& wrong) {
        add_fault(node.Mark().line + 1, std::string(key) + ": " + wrong.what());
    }
    return true;
}

void MapFileReader::want(const char* key, bool found) {
    if (!found) add_fault(1, std::string(key) + ": is missing; every map has one");
}

void MapFileReader::read_origin() {
    const auto metres = [](const YAML::Node& node) {
        return number(node, -position_limit_m, position_limit_m,
                      "x and y must be metres within 1e7");
    };
    const bool found = use("origin", [&](const YAML::Node& node) {
        if (!node.IsSequence() || node.size() != 3) {
            throw std::invalid_argument("must be [x, y, yaw]");
        }
        map_.origin_m = {metres(node[0]), metres(node[1])};
        map_.yaw_rad = number(node[2], -1e3, 1e3, "yaw must be an angle in radians");
    });
    want("origin", found);
}

void MapFileReader::read_thresholds() {
    const auto read = [&](const char* key, double& target, const char* taken) {
        if (use(key, [&](const YAML::Node& node) { target = threshold(node); })) return;
        map_.warnings.push_back(file_.string() + ": has no " + key + "; " + taken +
                                " is taken, as ROS 1 saves it");
    };
    read("occupied_thresh", map_.occupied_above, "0.65");
    read("free_thresh", map_.free_below, "0.196");
    if (faults_.empty() && map_.free_below > map_.occupied_above) {
        add_fault(
            document_["free_thresh"].IsDefined() ? document_["free_thresh"].Mark().line + 1 : 1,
            "free_thresh: must not be above occupied_thresh");
    }
}

MapFile MapFileReader::read() && {
    if (!document_.IsMap()) {
        add_fault(1, "is no map of map_server, which has keys such as `image: hall.pgm`");
        throw LoadError(std::move(faults_));
    }
    want("image", use("image", [&](const YAML::Node& node) {
             if (!node.IsScalar()) throw std::invalid_argument("must name a picture");
             map_.image = image_path(node.Scalar(), file_.parent_path());
         }));
    want("resolution", use("resolution", [&](const YAML::Node& node) {
             map_.resolution_m =
                 number(node, 1e-4, 1e3, "must be within 0.0001 and 1000 m a pixel");
         }));
    read_origin();
    use("mode", [&](const YAML::Node& node) { map_.mode = mode_of(node); });
    want("negate", use("negate", [&](const YAML::Node& node) { map_.negate = truth(node); }));
    read_thresholds();
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    return std::move(map_);
}

YAML::Node parse_yaml(const std::string& text, const fs::path& file) {
    const auto refuse = [&](int line, const std::string& what) {
        throw LoadError({file.string() + ':' + std::to_string(line) + ": " + what});
    };
    try {
        return YAML::Load(text);
    } catch (const YAML::DeepRecursion& error) {
        refuse(error.mark.line + 1, "nested too deeply to be a map");
    } catch (const YAML::Exception& error) {
        refuse(error.mark.line + 1, "not YAML: " + printable(error.msg));
    }
    return {};
}

}  // namespace

MapFile parse_map_file(const std::string& text, const fs::path& file) {
    return MapFileReader{parse_yaml(text, file), file}.read();
}

}  // namespace scipd::sim
