// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_kind.h"

#include <algorithm>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t longest_shown = 60;

/// In the words of the library that found it, less its prefix.
std::string broken_xml(const tinyxml2::XMLDocument& parsed) {
    std::string_view name = parsed.ErrorName();
    for (const std::string_view prefix : {"XML_", "ERROR_"}) {
        if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
    }
    const int line = std::max(parsed.ErrorLineNum(), 1);
    return ':' + std::to_string(line) + ": is no XML that can be read: " + std::string{name};
}

bool begins_with(std::string_view text, std::string_view beginning) {
    const auto lower = [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    };
    return std::ranges::equal(text.substr(0, beginning.size()), beginning, {}, lower);
}

/// Where people keep a page or a pointer for the file itself; empty where nothing is known.
std::string known_kind(std::string_view text) {
    if (begins_with(text, "<!doctype html") || begins_with(text, "<html")) {
        return "is a page of HTML, no SDF; download the file itself, not the page that shows it";
    }
    if (begins_with(text, "version https://git-lfs")) {
        return "is a pointer of Git LFS, no SDF; fetch the file itself with `git lfs pull`";
    }
    if (text.empty() || text.front() == '<') return {};
    return "is no SDF; it begins with '" +
           printable(text.substr(0, text.find_first_of("\r\n")), longest_shown) +
           "', an SDF file with <sdf>";
}

}  // namespace

std::string why_no_sdf(const std::string& text, const tinyxml2::XMLDocument& parsed) {
    std::string_view start = text;
    if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    const auto* root = parsed.Error() ? nullptr : parsed.RootElement();
    const std::string_view name = root == nullptr ? "" : root->Name();
    // <gazebo> is what <sdf> was called up to its version 1.2.
    if (name == "sdf" || name == "robot" || name == "gazebo") return {};
    if (const auto kind = known_kind(start); !kind.empty()) return ":1: " + kind;
    if (parsed.Error()) return broken_xml(parsed);
    if (root == nullptr) return ":1: is no SDF: holds no element";
    return ':' + std::to_string(root->GetLineNum()) + ": is no SDF: its root is <" +
           printable(name, longest_shown) + ">, not <sdf>";
}

}  // namespace scipd::sim
