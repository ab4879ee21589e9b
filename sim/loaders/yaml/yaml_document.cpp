// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/yaml/yaml_document.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_faults = 100;
constexpr std::size_t longest_sentence = 1000;

constexpr std::size_t most_entries = 4096;

std::string path_of(const YamlField& map, std::string_view key) {
    const auto shown = printable(key, 64);
    return map.path.empty() ? shown : map.path + "." + shown;
}

/// Hears a document and keeps only where it began.
class DocumentStart : public YAML::EventHandler {
  public:
    int line = 0;

  private:
    using Text = const std::string&;
    using Style = YAML::EmitterStyle::value;
    using Anchor = YAML::anchor_t;
    void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, Anchor) override {}
    void OnAlias(const YAML::Mark&, Anchor) override {}
    void OnScalar(const YAML::Mark&, Text, Anchor, Text) override {}
    void OnSequenceStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnMapEnd() override {}
};

/// Not by YAML::LoadAll(): in yaml-cpp 0.7 it never ends on `!tag,`.
void refuse_second_document(const std::string& text, YamlFaults& faults) {
    std::istringstream stream{text};
    YAML::Parser parser{stream};
    DocumentStart start;
    if (parser.HandleNextDocument(start) && parser.HandleNextDocument(start)) {
        faults.add(start.line, {}, "a second YAML document; keep one");
    }
}

/// True if a tab is part of the indentation of this line, counted from 0.
bool is_indented_by_tab(const std::string& text, int line) {
    std::istringstream stream{text};
    std::string found;
    for (int i = 0; i <= line; ++i)
        std::getline(stream, found);
    return found.find('\t') < found.find_first_not_of(" \t");
}

std::string syntax_error(const std::string& text, const YAML::Exception& error) {
    if (is_indented_by_tab(text, error.mark.line))
        return "YAML does not allow tabs for indentation; use spaces";
    const bool star = error.msg == YAML::ErrorMsg::ALIAS_NOT_FOUND;
    return "not YAML: " + error.msg + (star ? R"(; a star by itself needs quotes: "*")" : "");
}

}  // namespace

std::string YamlFaults::place(int line, std::string_view path) const {
    std::string place = file_ + ":" + std::to_string(line) + ": ";
    if (!path.empty()) place.append(path).append(": ");
    return place;
}

void YamlFaults::add(int line, std::string_view path, std::string_view sentence) {
    // Sentences may hold what a library quotes as it is: a fault stays one line that can be shown.
    found_.push_back({line, {std::string(path), printable(sentence, longest_sentence)}});
    if (found_.size() < most_faults) return;
    found_.push_back({line, {{}, "too many faults; there may be more from here on"}});
    throw_if_any();
}

std::optional<Fault> YamlFaults::first() const {
    return found_.empty() ? std::nullopt : std::optional(found_.front().fault);
}

void YamlFaults::throw_if_any() const {
    if (found_.empty()) return;
    auto ordered = found_;
    std::ranges::stable_sort(ordered, {}, &Found::line);
    std::vector<std::string> faults;
    for (const auto& [line, fault] : ordered)
        faults.push_back(place(line, fault.field) + fault.why);
    throw LoadError(std::move(faults));
}

YAML::Node parse_yaml(const std::string& text, std::string_view what, YamlFaults& faults) {
    try {
        auto document = YAML::Load(text);
        refuse_second_document(text, faults);
        return document.IsNull() ? YAML::Node{YAML::NodeType::Map} : document;
    } catch (const YAML::DeepRecursion& error) {
        faults.add(error.mark.line + 1, {}, "nested too deeply to be " + std::string(what));
    } catch (const YAML::Exception& error) {
        faults.add(error.mark.line + 1, {}, syntax_error(text, error));
    }
    faults.throw_if_any();
    return {};
}

std::vector<YamlField> entries(const YamlField& map, YamlFaults& faults, std::string_view advice) {
    if (!map.value.IsMap()) {
        faults.add(map, "must be a map of keys and values" + std::string(advice));
        return {};
    }
    if (map.value.size() > most_entries) {
        faults.add(map, "has more than 4096 entries; split it");
        return {};
    }
    std::vector<YamlField> fields;
    std::map<std::string, int> line_of;
    for (const auto& entry : map.value) {
        const int line = entry.first.Mark().line + 1;
        if (!entry.first.IsScalar()) {
            faults.add(line, map.path, "a key must be a plain name");
            continue;
        }
        YamlField field{entry.first.Scalar(), path_of(map, entry.first.Scalar()), line,
                        entry.second};
        const auto [first, is_new] = line_of.emplace(field.key, line);
        if (!is_new) {
            faults.add(field, "given twice, first in line " + std::to_string(first->second) +
                                  "; keep one");
            continue;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

std::optional<YamlField> entry_of(const YamlField& map, std::string_view key) {
    if (!map.value.IsMap()) return std::nullopt;
    for (const auto& entry : map.value) {
        if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
        return YamlField{std::string(key), path_of(map, key), entry.first.Mark().line + 1,
                         entry.second};
    }
    return std::nullopt;
}

Expected<std::string> text_of(const YAML::Node& value) {
    if (value.IsScalar()) return value.Scalar();
    if (value.IsNull()) return refuse("has no value; give one or leave the key out");
    return refuse(std::string{"must be a single value, not a "} + (value.IsMap() ? "map" : "list"));
}

Expected<std::vector<double>> numbers_of(const YAML::Node& value, std::size_t count,
                                         ParseNumber parse, const std::string& advice) {
    if (!value.IsSequence() || value.size() != count) return refuse(advice);
    std::vector<double> numbers;
    for (const YAML::Node& item : value) {
        const auto number = text_of(item).and_then(parse);
        if (!number) return tl::unexpected(number.error());
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace scipd::sim
