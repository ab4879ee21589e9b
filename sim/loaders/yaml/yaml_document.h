// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A YAML document: its maps, lists and single values, each with its place. What is wrong becomes a
// fault. Knows nothing of what a document means. One thread at a time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_faults.h"
#include "sim/text/quote.h"

namespace scipd::sim {

/// Reads the one YAML document that a file is; no text at all is an empty map. A second document is
/// a fault. Throws LoadError where the text is no YAML. `what` says what it was to be: "a map".
YAML::Node parse_yaml(const std::string& text, std::string_view what, YamlFaults& faults);

/// The entries of a map, in the order of the file. A value that is no map is a fault, and so is a
/// key that is no plain name or stands there twice. `advice` ends the message about a value that is
/// no map.
std::vector<YamlField> entries(const YamlField& map, YamlFaults& faults,
                               std::string_view advice = {});

/// One entry of a map, whatever the others are; nothing where it is not there.
std::optional<YamlField> entry_of(const YamlField& map, std::string_view key);

/// The text of a single value, which is no map and no list.
Expected<std::string> text_of(const YAML::Node& value);

/// The numbers of a list; where there are not so many, `advice` is the fault.
using ParseNumber = Expected<double> (*)(std::string_view text);
Expected<std::vector<double>> numbers_of(const YAML::Node& value, std::size_t count,
                                         ParseNumber parse, const std::string& advice);

}  // namespace scipd::sim
