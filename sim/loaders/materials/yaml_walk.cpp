// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/materials/yaml_walk.h"

#include <map>
#include <utility>

#include <yaml-cpp/depthguard.h>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_yaml_entries = 4096;
constexpr std::size_t most_yaml_faults = 100;

}  // namespace

YamlField YamlWalk::document(const std::string& text) const {
    const auto refuse = [&](int line, const std::string& what) {
        throw LoadError({file_ + ':' + std::to_string(line) + ": " + what});
    };
    try {
        return {{}, {}, 1, YAML::Load(text)};
    } catch (const YAML::DeepRecursion& error) {
        refuse(error.mark.line + 1, "nested too deeply to be a library of materials");
    } catch (const YAML::Exception& error) {
        refuse(error.mark.line + 1, "not YAML: " + printable(error.msg));
    }
    return {};
}

void YamlWalk::throw_if_any() const {
    if (!faults_.empty()) throw LoadError(faults_);
}

void YamlWalk::add_fault(const YamlField& field, const std::string& text) {
    const std::string place = file_ + ':' + std::to_string(field.line) + ": ";
    faults_.push_back(place + (field.path.empty() ? "" : field.path + ": ") + text);
    if (faults_.size() < most_yaml_faults) return;
    faults_.push_back(place + "too many faults; there may be more from here on");
    throw LoadError(std::move(faults_));
}

std::vector<YamlField> YamlWalk::entries(const YamlField& map, const char* otherwise) {
    if (!map.value.IsMap() || map.value.size() == 0 || map.value.size() > most_yaml_entries) {
        add_fault(map, otherwise);
        return {};
    }
    std::vector<YamlField> fields;
    std::map<std::string, int> line_of_key;
    for (const auto& entry : map.value) {
        YamlField field{map.path, {}, entry.first.Mark().line + 1, entry.second};
        if (!entry.first.IsScalar()) {
            add_fault(field, "a key must be a plain name");
            continue;
        }
        field.key = entry.first.Scalar();
        field.path += (map.path.empty() ? "" : ".") + printable(field.key, 64);
        const auto [first, is_new] = line_of_key.emplace(field.key, field.line);
        if (is_new) {
            fields.push_back(std::move(field));
        } else {
            add_fault(field,
                      "given twice, first in line " + std::to_string(first->second) + "; keep one");
        }
    }
    return fields;
}

std::vector<std::string> YamlWalk::texts(const YamlField& list, const char* otherwise) {
    std::vector<std::string> texts;
    const bool fits = list.value.IsSequence() && list.value.size() <= most_yaml_entries;
    if (fits) {
        for (const YAML::Node& item : list.value) {
            if (item.IsScalar()) texts.push_back(item.Scalar());
        }
    }
    if (!fits || texts.size() != list.value.size()) add_fault(list, otherwise);
    return texts;
}

}  // namespace scipd::sim
