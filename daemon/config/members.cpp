// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/members.h"

#include <string>

namespace scipd::daemon {
namespace {

/// For a list of numbers without its brackets: "400,500".
std::string advice(const YAML::Node& value) {
    const std::string text = value.IsScalar() ? value.Scalar() : "";
    const bool numbers = text.find_first_not_of("0123456789+-.e, ") == std::string::npos;
    if (!numbers || text.find(',') == std::string::npos || text.size() > longest_list) return {};
    return ": write [" + text + "]";
}

}  // namespace

sim::Expected<std::vector<sim::YamlField>> items(const sim::YamlField& list) {
    if (!list.value.IsSequence() || list.value.size() > longest_list)
        return sim::refuse("must be a list of at most 64, in brackets" + advice(list.value));
    std::vector<sim::YamlField> fields;
    for (const YAML::Node& item : list.value)
        fields.push_back({list.key, list.path, item.Mark().line + 1, item});
    return fields;
}

}  // namespace scipd::daemon
