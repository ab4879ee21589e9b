// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_kind.h"

#include <algorithm>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/mistaken_file.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t longest_shown = 60;

/// The name that tinyxml2 gives to the error, without its prefix.
std::string broken_xml(const tinyxml2::XMLDocument& parsed) {
    std::string_view name = parsed.ErrorName();
    for (const std::string_view prefix : {"XML_", "ERROR_"}) {
        if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
    }
    const int line = std::max(parsed.ErrorLineNum(), 1);
    return ':' + std::to_string(line) + ": is no XML that can be read: " + std::string{name};
}

/// What kind of text this is; empty if unknown.
std::string known_kind(std::string_view text) {
    if (auto why = why_mistaken(text, "SDF"); !why.empty()) return why;
    if (text.empty() || text.front() == '<') return {};
    return "is no SDF; it begins with '" +
           printable(text.substr(0, text.find_first_of("\r\n")), longest_shown) +
           "', and an SDF file begins with <sdf>";
}

}  // namespace

std::string why_no_sdf(const std::string& text, const tinyxml2::XMLDocument& parsed) {
    const auto* root = parsed.Error() ? nullptr : parsed.RootElement();
    const std::string_view name = root == nullptr ? "" : root->Name();
    // Up to SDF 1.2, <sdf> was called <gazebo>.
    if (name == "sdf" || name == "robot" || name == "gazebo") return {};
    const std::string kind = known_kind(without_blank_start(text));
    if (!kind.empty()) return ":1: " + kind;
    if (parsed.Error()) return broken_xml(parsed);
    if (root == nullptr) return ":1: is no SDF: holds no element";
    return ':' + std::to_string(root->GetLineNum()) + ": is no SDF: its root is <" +
           printable(name, longest_shown) + ">, not <sdf>";
}

}  // namespace scipd::sim
