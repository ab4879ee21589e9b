// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/source_tree.h"

#include <algorithm>
#include <array>
#include <deque>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>

#include "tests/support/folder_law.h"

namespace scipd::testing {
namespace {

constexpr std::array<std::string_view, 5> roots{"protocol/", "sim/", "daemon/", "tools/",
                                                "testing/"};

/// An include that no folder's law may allow.
struct Ban {
    std::string_view folder;
    std::string_view included;
    std::string_view except;
    std::string_view reason;
};

constexpr std::array bans = {
    Ban{"", "tests/", "-", "nothing that is shipped leans on the tests"},
    Ban{"protocol/", "protocol/client/", "protocol/client/",
        "the scanner's side does not know the host's"},
    Ban{"daemon/", "protocol/client/", "daemon/recording/",
        "the daemon is the scanner, not a host; only recordings have what hosts have heard"},
    Ban{"daemon/", "tools/", "-", "tools stand on the daemon's libraries, not under them"},
    Ban{"tools/", "daemon/device/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/link/", "tools/scipcat/proxy/",
        "tools talk to the daemon from outside; to a driver, a proxy is a scanner as the daemon "
        "is"},
    Ban{"tools/", "daemon/api/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/program/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/plan/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/rig/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/service/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/http/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/poses/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/world/", "-", "tools talk to the daemon from outside"},
    Ban{"daemon/", "embree", "-", "Embree lives behind sim/backends/embree"},
    Ban{"tools/", "embree", "-", "Embree lives behind sim/backends/embree"},
    Ban{"daemon/", "sdf/", "-", "SDF is read by sim/loaders"},
    Ban{"daemon/", "assimp/", "-", "meshes are read by sim/loaders"},
};

/// The sources that put the folders of the daemon together.
const Names right_in_daemon{"main.cpp", "server.cpp", "server.h"};

bool is_source(std::string_view path) {
    return path.ends_with(".h") || path.ends_with(".cpp");
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Include {
    int line;
    std::string_view file;
};

std::vector<Include> includes_of(std::string_view text) {
    std::vector<Include> includes;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::size_t begin = line.find_first_of("\"<");
        const std::size_t end = line.find_last_of("\">");
        if (!line.starts_with("#include") || begin == line.npos || end <= begin) continue;
        includes.push_back({number, line.substr(begin + 1, end - begin - 1)});
    }
    return includes;
}

std::string readme_of(std::string_view folder) {
    return std::string{folder} + "README.md";
}

std::optional<FolderLaw> law_of(const SourceTree& tree, std::string_view folder) {
    const auto readme = tree.find(readme_of(folder));
    return readme == tree.end() ? std::nullopt : law_in(readme->second);
}

/// The law of a folder without one. faults_of_laws() reports that.
const FolderLaw no_law;

std::set<std::string, std::less<>> folders_in(const SourceTree& tree) {
    std::set<std::string, std::less<>> folders;
    for (const auto& [path, text] : tree) {
        if (is_source(path)) folders.emplace(folder_of(path));
    }
    return folders;
}

std::string_view why_banned(std::string_view file, std::string_view included) {
    for (const Ban& ban : bans) {
        if (file.starts_with(ban.folder) && included.starts_with(ban.included) &&
            !file.starts_with(ban.except))
            return ban.reason;
    }
    return {};
}

/// Names in a law that match no file of the project, and exempt files that do not exist.
Names stale_names(const SourceTree& tree, const std::string& folder, const FolderLaw& law) {
    Names stale;
    const auto check = [&](const Names& names) {
        for (const std::string& name : names) {
            const bool is_ours = std::ranges::any_of(
                roots, [&](std::string_view root) { return name.starts_with(root); });
            const bool stands_for_some = std::ranges::any_of(
                tree, [&](const auto& file) { return is_among(file.first, {name}); });
            if (is_ours && !stands_for_some) stale.push_back(name);
        }
    };
    check(law.may_include);
    check(law.never_reaches);
    for (const Exemption& exemption : law.exemptions) {
        check(exemption.may_include);
        for (const std::string& file : exemption.files) {
            if (!tree.contains(folder + file)) stale.push_back(file);
        }
    }
    return stale;
}

/// The headers on the way from a file to the first header that is ruled out, without the file
/// itself; empty if there is none.
Names way_from(const SourceTree& tree, const std::string& file, const Names& ruled_out) {
    std::map<std::string, std::string, std::less<>> reached_from{{file, ""}};
    std::deque<std::string> open{file};
    for (; !open.empty(); open.pop_front()) {
        const auto source = tree.find(open.front());
        if (source == tree.end()) continue;
        for (const Include& include : includes_of(source->second)) {
            const std::string header{include.file};
            if (!reached_from.emplace(header, open.front()).second) continue;
            open.push_back(header);
            if (!is_among(header, ruled_out)) continue;
            Names way;
            for (std::string at = header; at != file; at = reached_from[at])
                way.insert(way.begin(), at);
            return way;
        }
    }
    return {};
}

using Arrows = std::set<std::pair<std::string, std::string>>;

void add_pairs(const Arrows& arrows, std::vector<std::string>& pairs) {
    for (const auto& [from, to] : arrows) {
        if (from < to && arrows.contains({to, from})) pairs.push_back(from + " <-> " + to);
    }
}

}  // namespace

SourceTree tree_at(const std::filesystem::path& root) {
    SourceTree tree;
    for (const std::string_view folder : roots) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const auto path = std::filesystem::relative(entry.path(), root).generic_string();
            if (is_source(path) || path.ends_with("/README.md")) tree[path] = contents(entry);
        }
    }
    return tree;
}

std::vector<std::string> faults_of_laws(const SourceTree& tree) {
    std::vector<std::string> faults;
    for (const std::string& folder : folders_in(tree)) {
        const auto law = law_of(tree, folder);
        if (!law) {
            faults.push_back(readme_of(folder) +
                             " has no line that begins with `- May include:`; say there what this "
                             "folder may include");
            continue;
        }
        for (const std::string& name : stale_names(tree, folder, *law))
            faults.push_back(readme_of(folder) + " names " + name + ", which is not there");
    }
    return faults;
}

std::vector<std::string> faults_of_includes(const SourceTree& tree) {
    std::vector<std::string> faults;
    for (const auto& [path, text] : tree) {
        if (!is_source(path)) continue;
        const FolderLaw law = law_of(tree, folder_of(path)).value_or(no_law);
        for (const auto& [line, included] : includes_of(text)) {
            const auto place = path + ":" + std::to_string(line) + " includes ";
            if (const auto why = why_banned(path, included); !why.empty()) {
                faults.push_back(place + std::string{included} + ": " + std::string{why});
            } else if (!may_include(law, path, included)) {
                faults.push_back(place + std::string{included} + ", which " +
                                 readme_of(folder_of(path)) + " does not allow");
            }
        }
    }
    return faults;
}

std::vector<std::string> faults_of_reach(const SourceTree& tree) {
    std::vector<std::string> faults;
    for (const auto& [path, text] : tree) {
        if (!is_source(path)) continue;
        const FolderLaw law = law_of(tree, folder_of(path)).value_or(no_law);
        const Names way = way_from(tree, path, law.never_reaches);
        if (way.empty()) continue;
        std::string fault = path;
        for (const std::string& header : way)
            fault += " -> " + header;
        faults.push_back(fault + ": " + readme_of(folder_of(path)) + " rules that out");
    }
    return faults;
}

std::vector<std::string> faults_of_length(const SourceTree& tree) {
    std::vector<std::string> faults;
    for (const auto& [path, text] : tree) {
        if (!is_source(path)) continue;
        const auto lines = std::ranges::count(text, '\n');
        const bool is_header = path.ends_with(".h");
        const int budget = is_header ? 200 : 500;
        if (lines <= budget) continue;
        faults.push_back(path + " has " + std::to_string(lines) + " lines; a " +
                         (is_header ? "header" : "source") + " has at most " +
                         std::to_string(budget));
    }
    return faults;
}

std::vector<std::string> faults_of_names(const SourceTree& tree) {
    std::vector<std::string> faults;
    std::map<std::string_view, std::string_view> headers;
    for (const auto& [path, text] : tree) {
        const auto name = std::string_view{path}.substr(folder_of(path).size());
        if (folder_of(path) == "daemon/" && is_source(name) && !is_among(name, right_in_daemon))
            faults.push_back(path + " lies right in daemon/, which only puts its folders together");
        if (!name.ends_with(".h")) continue;
        const auto [first, is_new] = headers.emplace(name, path);
        if (!is_new)
            faults.push_back(path + " has the name of " + std::string{first->second} +
                             "; call it after what only it is about");
    }
    return faults;
}

std::vector<std::string> pairs_in(const SourceTree& tree) {
    const auto unit_of = [](std::string_view path) { return path.substr(0, path.rfind('.')); };
    Arrows of_units;
    Arrows of_folders;
    for (const auto& [path, text] : tree) {
        if (!is_source(path)) continue;
        for (const auto& [line, included] : includes_of(text)) {
            if (!tree.contains(included)) continue;
            of_units.emplace(unit_of(path), unit_of(included));
            of_folders.emplace(folder_of(path), folder_of(included));
        }
    }
    std::vector<std::string> pairs;
    add_pairs(of_units, pairs);
    add_pairs(of_folders, pairs);
    return pairs;
}

}  // namespace scipd::testing
