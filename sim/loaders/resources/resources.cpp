// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/resources/resources.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/any_case.h"
#include "sim/loaders/resources/model_folder.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array variables{
    "SDF_PATH",          "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH",
    "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH",
    "AMENT_PREFIX_PATH"};

/// SCHEME://NAME in two parts; a plain path has no scheme.
struct Uri {
    std::string scheme;
    std::string name;

    explicit Uri(const std::string& text) {
        const auto end = text.find("://");
        if (end != text.npos) scheme = text.substr(0, end);
        name = end == text.npos ? text : text.substr(end + 3);
    }

    [[nodiscard]] bool downloaded() const { return scheme == "http" || scheme == "https"; }
    /// NAME begins with the name of a model or a package.
    [[nodiscard]] bool named() const { return scheme == "model" || scheme == "package"; }
};

std::string with_each(std::string_view text, std::string_view wanted, std::string_view put) {
    std::string result;
    for (auto at = text.find(wanted); at != text.npos; at = text.find(wanted)) {
        result.append(text.substr(0, at)).append(put);
        text.remove_prefix(at + wanted.size());
    }
    return result.append(text);
}

bool is_there(const fs::path& path) {
    return !exactly({}, path).empty();
}

/// Looks for a name in a folder, exactly() as it is or in another spelling.
using Look = std::function<fs::path(const fs::path& folder, const fs::path& name)>;

/// A URI has %20 where a file has a blank. Some download tools keep %20 in the file names.
fs::path with_blanks(const fs::path& folder, const fs::path& name) {
    const std::string spelled = with_each(name.native(), "%20", " ");
    return spelled == name.native() ? fs::path{} : in_any_case(folder, spelled);
}
fs::path without_blanks(const fs::path& folder, const fs::path& name) {
    const std::string spelled = with_each(name.native(), " ", "%20");
    return spelled == name.native() ? fs::path{} : in_any_case(folder, spelled);
}

/// An exact name in any place is better than another spelling in an earlier one.
const std::array<Look, 4> looks{exactly, in_any_case, with_blanks, without_blanks};

/// The path of a name from Fuel in this folder, in any spelling; as it is if there is no such file.
fs::path as_spelled_in(const fs::path& folder, const std::string& name) {
    for (const Look look : {exactly, with_blanks, without_blanks}) {
        if (auto found = look(folder, name); !found.empty()) return found;
    }
    return folder / name;
}

std::vector<fs::path> folders_of(std::string_view variable) {
    std::vector<fs::path> folders;
    while (!variable.empty()) {
        const auto end = variable.find(':');
        if (const auto folder = variable.substr(0, end); !folder.empty()) {
            folders.emplace_back(folder);
        }
        variable.remove_prefix(end == variable.npos ? variable.size() : end + 1);
    }
    return folders;
}

fs::path near(const fs::path& folder, const Uri& uri, const Look& look) {
    const fs::path above = folder.parent_path();
    for (const auto& place : {folder, above, folder / "models", above / "models"}) {
        if (auto found = look(place, uri.name); !found.empty()) return found;
    }
    if (!uri.named()) return {};
    for (fs::path up = above.parent_path(); up.has_relative_path(); up = up.parent_path()) {
        if (auto found = look(up, uri.name); !found.empty()) return found;
    }
    return {};
}

fs::path below(const fs::path& folder, const Uri& uri, const Look& look) {
    for (const auto& place : {folder, folder / "share"}) {
        if (auto found = look(place, uri.name); !found.empty()) return found;
    }
    const fs::path name = uri.name;
    if (!uri.named() || name.empty()) return {};
    // The folder may be the package itself.
    if (folder.filename() == *name.begin()) {
        if (auto found = look(folder.parent_path(), name); !found.empty()) return found;
    }
    std::error_code error;
    std::vector<fs::path> stacks;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!is_there(entry.path() / name)) continue;
        if (auto found = look(entry.path(), name); !found.empty()) stacks.push_back(found);
    }
    // The order of a folder's entries is random, so take the first by name.
    return stacks.empty() ? fs::path{} : *std::ranges::min_element(stacks);
}

std::optional<int> number_in(const fs::path& path) {
    const std::string name = path.filename();
    const bool digits = std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
    if (!digits || name.empty() || name.size() > 9) return std::nullopt;
    return std::stoi(name);
}

fs::path newest_version(const fs::path& model) {
    fs::path newest;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(model, error)) {
        const auto version = number_in(entry.path());
        if (version && (newest.empty() || *version > *number_in(newest))) newest = entry.path();
    }
    return newest;
}

/// The folder name of the two models that most Gazebo worlds name by web address, such as
/// ground_plane for "Ground Plane". Empty for all others.
std::string name_in_folders(const Uri& uri) {
    const std::string name = with_each(with_each(lower(uri.name), "%20", "_"), " ", "_");
    constexpr std::string_view owner = "/openrobotics/models/";
    for (const std::string_view model : {"sun", "ground_plane"}) {
        if (name.ends_with(model) && name.substr(0, name.size() - model.size()).ends_with(owner)) {
            return std::string{model};
        }
    }
    return {};
}

/// Where gz-fuel-tools keeps HOST/1.0/OWNER/models/NAME[/VERSION[/files/PATH]]: in
/// HOST/owner/models/name/VERSION/PATH, in lower case up to the name.
fs::path downloaded_to(const fs::path& cache, const Uri& uri) {
    std::vector<std::string> part;
    for (const auto& piece : fs::path{uri.name})
        part.push_back(piece.string());
    if (part.size() < 5) return {};
    fs::path model = cache / part[0];
    for (const std::size_t i : {2U, 3U, 4U})
        model = as_spelled_in(model, lower(part[i]));
    const bool latest = part.size() < 6 || part[5] == "tip";
    fs::path found = latest ? newest_version(model) : model / part[5];
    for (std::size_t i = 7; i < part.size(); ++i)
        found = as_spelled_in(found, part[i]);
    return is_there(found) ? found : fs::path{};
}

std::vector<fs::path> caches() {
    std::vector<fs::path> caches;
    if (const char* cache = std::getenv("GZ_FUEL_CACHE_PATH")) caches.emplace_back(cache);
    if (const char* home = std::getenv("HOME")) {
        caches.push_back(fs::path{home} / ".gz/fuel");
        caches.push_back(fs::path{home} / ".ignition/fuel");
    }
    return caches;
}

fs::path find_download(const Uri& uri) {
    for (const auto& cache : caches()) {
        if (auto found = downloaded_to(cache, uri); !found.empty()) return found;
    }
    return {};
}

std::vector<fs::path> folders_in(const char* variable) {
    const char* value = std::getenv(variable);
    return folders_of(value == nullptr ? "" : value);
}

std::vector<fs::path> folders_of_variables() {
    std::vector<fs::path> all;
    for (const char* variable : variables) {
        const auto folders = folders_in(variable);
        all.insert(all.end(), folders.begin(), folders.end());
    }
    return all;
}

}  // namespace

std::vector<fs::path> resource_folders() {
    auto folders = folders_of_variables();
    for (auto& cache : caches())
        folders.push_back(std::move(cache));
    return folders;
}

Resources::Resources(fs::path folder, std::vector<fs::path> more)
    : folder_(std::move(folder)),
      search_path_(folders_of_variables()),
      package_path_(folders_in("ROS_PACKAGE_PATH")) {
    search_path_.insert(search_path_.end(), more.begin(), more.end());
}

fs::path Resources::find(const std::string& text, const fs::path& beside) const {
    const Uri uri{text};
    if (uri.name.empty()) return {};
    if (uri.downloaded()) {
        const fs::path found = find_download(uri);
        const std::string ours = found.empty() ? name_in_folders(uri) : "";
        return ours.empty() ? found : find(std::string{"model://"}.append(ours), beside);
    }
    fs::path bare;
    for (std::size_t look = 0; look < looks.size(); ++look) {
        for (const auto& start : {beside, folder_, fs::path{}}) {
            Found found = once({look, start, text});
            if (!found.path.empty()) return found.path;
            if (bare.empty()) bare = std::move(found.bare);
        }
    }
    return bare;
}

Resources::Found Resources::once(const Search& search) const {
    if (const auto known = known_.find(search); known != known_.end()) return known->second;
    // Enough for all worlds but those that are made to take memory.
    constexpr std::size_t most_known = 50'000;
    if (known_.size() >= most_known) known_.clear();
    return known_[search] = search_for(search);
}

Resources::Found Resources::search_for(const Search& search) const {
    const auto& [kind, start, text] = search;
    const Uri uri{text};
    Found found;
    const Look look = [&, kind = kind](const fs::path& folder, const fs::path& name) {
        fs::path path = looks[kind](folder, name);
        std::error_code error;
        if (!fs::is_directory(path, error) || is_model_folder(path)) return path;
        if (found.bare.empty()) found.bare = std::move(path);
        return fs::path{};
    };
    if (!start.empty()) found.path = near(start, uri, look);
    for (std::size_t i = 0; start.empty() && found.path.empty() && i < search_path_.size(); ++i)
        found.path = below(search_path_[i], uri, look);
    if (!found.path.empty() || !uri.named()) return found;
    const fs::path name = uri.name;
    for (const fs::path& package : packages_called(name.begin()->string(), start)) {
        found.path = looks[kind](package, name.lexically_relative(*name.begin()));
        std::error_code error;
        if (!found.path.empty() && !fs::is_directory(found.path, error)) return found;
    }
    found.path.clear();
    return found;
}

/// The folders around `from` whose own file gives them this name, and the packages beside them; for
/// no folder, those along the path of packages.
std::vector<fs::path> Resources::packages_called(const std::string& name,
                                                 const fs::path& from) const {
    std::vector<fs::path> called;
    const auto look_into = [&](const fs::path& folder, int levels) {
        if (calls_itself(folder, name)) called.push_back(folder);
        const Packages& packages = packages_below(folder, levels);
        if (const auto package = packages.find(name); package != packages.end())
            called.push_back(package->second);
    };
    for (fs::path up = from; up.has_relative_path(); up = up.parent_path())
        look_into(up, 1);
    constexpr int deepest = 4;
    for (const fs::path& folder : from.empty() ? package_path_ : std::vector<fs::path>{})
        look_into(folder, deepest);
    return called;
}

/// No package lies in another one. A folder's entries are in random order: of two packages of one
/// name, the first by its path counts.
const Resources::Packages& Resources::packages_below(const fs::path& folder, int levels) const {
    const auto [known, is_new] = packages_.try_emplace({folder, levels});
    int left = is_new ? 50'000 : 0;  // entries to look at, far more than workspaces have
    std::error_code error;
    constexpr auto all = fs::directory_options::follow_directory_symlink |
                         fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator at{folder, all, error}, end;
         !error && at != end && left > 0; at.increment(error), --left) {
        std::error_code unknown;
        if (!at->is_directory(unknown)) continue;
        const std::string name = package_name(at->path());
        fs::path& place = known->second[name];
        if (place.empty() || at->path() < place) place = at->path();
        const bool hidden = at->path().filename().native().starts_with('.');
        if (!name.empty() || hidden || at.depth() + 1 >= levels) at.disable_recursion_pending();
    }
    return known->second;
}

std::string Resources::not_found(const std::string& text, const fs::path& beside) const {
    const Uri uri{text};
    if (text.empty()) return "no file is named";
    if (uri.downloaded()) {
        return quote(text, whole_path) + " has not been downloaded; fetch it with `" +
               printable(download_command(text), whole_path) + "`, or name a copy";
    }
    std::string sentence =
        "there is no " + quote(text, whole_path) + " near " + shown(beside.string());
    if (uri.named()) {
        sentence +=
            ", nor in GZ_SIM_RESOURCE_PATH, GAZEBO_MODEL_PATH, SDF_PATH, ROS_PACKAGE_PATH or "
            "AMENT_PREFIX_PATH";
    }
    if (uri.scheme == "file") sentence += ", nor in GAZEBO_RESOURCE_PATH or GZ_SIM_RESOURCE_PATH";
    return sentence + or_in_no_folder();
}

std::string download_command(const std::string& text) {
    const Uri uri{text};
    if (!uri.downloaded()) return {};
    // Keeps only the model of HOST/1.0/OWNER/models/NAME/VERSION/files/PATH.
    std::string model = text;
    if (const auto files = text.find("/files/"); files != text.npos) {
        model.resize(files);
        if (model.ends_with("/tip")) model.resize(model.size() - 4);
    }
    for (auto at = model.find('\''); at != model.npos; at = model.find('\'', at + 4))
        model.replace(at, 1, "'\\''");
    return "gz fuel download -u '" + model + '\'';
}

std::string case_warning(const std::string& text, const fs::path& found) {
    const Uri uri{text};
    if (uri.downloaded() || !differs_in_case(found, uri.name)) return {};
    return quote(text, whole_path) + " is called " + shown(found.string()) +
           " here; it is used, though the names differ in case";
}

}  // namespace scipd::sim
