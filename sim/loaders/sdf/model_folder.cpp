// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/model_folder.h"

#include <cstdio>
#include <string>
#include <string_view>
#include <tuple>

#include <tinyxml2.h>

#include "sim/loaders/load_error.h"
#include "sim/loaders/plain_file.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_config = 1U << 20U;

/// In the order of versions: 1.10 comes after 1.9.
using Version = std::tuple<int, int>;
constexpr Version newest{1, 9};

Version version_of(const tinyxml2::XMLElement& sdf) {
    int major = 0;
    int minor = 0;
    const char* text = sdf.Attribute("version");
    if (text != nullptr) std::sscanf(text, "%d.%d", &major, &minor);
    return {major, minor};
}

/// model.config, or the name that it had before.
std::string config_of(const fs::path& folder) {
    for (const char* name : {"model.config", "manifest.xml"}) {
        if (why_no_file(folder / name).empty()) {
            return read_file(folder / name, largest_config, "a model.config is wanted here");
        }
    }
    return {};
}

}  // namespace

fs::path model_file_of(const fs::path& path) {
    std::error_code error;
    if (!fs::is_directory(path, error)) return path;
    tinyxml2::XMLDocument config;
    if (config.Parse(config_of(path).c_str()) != tinyxml2::XML_SUCCESS) return {};
    const auto* model = config.FirstChildElement("model");
    const auto* sdf = model == nullptr ? nullptr : model->FirstChildElement("sdf");
    fs::path best;
    for (Version highest{}; sdf != nullptr; sdf = sdf->NextSiblingElement("sdf")) {
        const Version version = version_of(*sdf);
        if (version <= highest || version > newest || sdf->GetText() == nullptr) continue;
        highest = version;
        best = path / sdf->GetText();
    }
    return best;
}

}  // namespace scipd::sim
