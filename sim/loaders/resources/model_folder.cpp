// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/resources/model_folder.h"

#include <cstdio>
#include <string>
#include <string_view>
#include <tuple>

#include <tinyxml2.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/any_case.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_config = 1U << 20U;

/// Compares like versions: 1.10 comes after 1.9.
using Version = std::tuple<int, int>;
constexpr Version newest{1, 12};

Version version_of(const tinyxml2::XMLElement& sdf) {
    int major = 0;
    int minor = 0;
    const char* text = sdf.Attribute("version");
    if (text != nullptr) std::sscanf(text, "%d.%d", &major, &minor);
    return {major, minor};
}

/// The file of this name in any case of letters, with a warning if the case differs; empty if none.
fs::path there(const fs::path& folder, const fs::path& name, std::vector<std::string>& warnings) {
    fs::path found = in_any_case(folder, name);
    if (!found.empty() && differs_in_case(found, name)) {
        warnings.push_back(quote(name.string(), whole_path) + " is called " +
                           shown(found.string()) +
                           " here; it is used, though the names differ in case");
    }
    return found;
}

/// The text of model.config, or of manifest.xml, its former name.
std::string config_of(const fs::path& folder, std::vector<std::string>& warnings) {
    for (const char* name : {"model.config", "manifest.xml"}) {
        const fs::path config = there(folder, name, warnings);
        if (!config.empty() && check_plain_file(config)) {
            return read_file(config, largest_config, "a model.config is wanted here");
        }
    }
    return {};
}

/// The <name> in this file; empty if there is none. A file that cannot be read is reported where
/// its contents are wanted.
std::string name_in(const fs::path& file) {
    if (!check_plain_file(file)) return {};
    tinyxml2::XMLDocument config;
    try {
        config.Parse(read_file(file, largest_config, "a name is sought here").c_str());
    } catch (const LoadError&) {
        return {};
    }
    const auto* root = config.RootElement();
    const auto* name = root == nullptr ? nullptr : root->FirstChildElement("name");
    return name == nullptr || name->GetText() == nullptr ? "" : name->GetText();
}

/// Whether to read `one` rather than `other`.
bool is_better(const Version& one, const Version& other) {
    const bool reads_one = one <= newest;
    const bool reads_other = other <= newest;
    if (reads_one != reads_other) return reads_one;
    return reads_one ? one > other : one < other;
}

}  // namespace

fs::path model_file_of(const fs::path& path, std::vector<std::string>& warnings) {
    std::error_code error;
    if (!fs::is_directory(path, error)) return path;
    tinyxml2::XMLDocument config;
    if (config.Parse(config_of(path, warnings).c_str()) != tinyxml2::XML_SUCCESS) return {};
    const auto* model = config.FirstChildElement("model");
    const tinyxml2::XMLElement* best = nullptr;
    for (const auto* sdf = model == nullptr ? nullptr : model->FirstChildElement("sdf");
         sdf != nullptr; sdf = sdf->NextSiblingElement("sdf")) {
        if (sdf->GetText() == nullptr) continue;
        if (best == nullptr || is_better(version_of(*sdf), version_of(*best))) best = sdf;
    }
    if (best == nullptr) return {};
    fs::path found = there(path, best->GetText(), warnings);
    return found.empty() ? path / best->GetText() : found;
}

Expected<> check_model(const fs::path& path, const fs::path& model) {
    if (const auto allowed = check_allowed(path); !allowed) return allowed;
    const auto plain = check_plain_file(model);
    std::error_code error;
    if (plain || !fs::is_directory(path, error)) return plain;
    return refuse("is the folder " + path.string() +
                  ", which has no model.config that names an SDF file");
}

bool is_model_folder(const fs::path& folder) {
    return !in_any_case(folder, "model.config").empty() ||
           !in_any_case(folder, "manifest.xml").empty();
}

bool calls_itself(const fs::path& folder, const std::string& name) {
    return !name.empty() &&
           (name_in(folder / "model.config") == name || name_in(folder / "manifest.xml") == name ||
            package_name(folder) == name);
}

std::string package_name(const fs::path& folder) {
    return name_in(folder / "package.xml");
}

}  // namespace scipd::sim
