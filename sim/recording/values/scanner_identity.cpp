// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/values/scanner_identity.h"

#include <array>
#include <charconv>
#include <string_view>

#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

template <class Value>
using Member = Value ScannerIdentity::*;

struct TextField {
    const char* key;
    Member<std::string> value;
};
constexpr std::array text_fields = {
    TextField{"model", &ScannerIdentity::model},
    TextField{"serial", &ScannerIdentity::serial},
    TextField{"firmware", &ScannerIdentity::firmware},
};

struct NumberField {
    const char* key;
    Member<std::optional<double>> value;
};
constexpr std::array number_fields = {
    NumberField{"min_range_m", &ScannerIdentity::min_range_m},
    NumberField{"max_range_m", &ScannerIdentity::max_range_m},
    NumberField{"rpm", &ScannerIdentity::rpm},
};

struct StepField {
    const char* key;
    Member<std::optional<int>> value;
};
constexpr std::array step_fields = {
    StepField{"steps_per_turn", &ScannerIdentity::steps_per_turn},
    StepField{"front_step", &ScannerIdentity::front_step},
};

struct AnswerField {
    std::string_view prefix;
    Member<Entries> value;
};
constexpr std::array answer_fields = {
    AnswerField{"VV.", &ScannerIdentity::version},
    AnswerField{"PP.", &ScannerIdentity::parameters},
    AnswerField{"II.", &ScannerIdentity::state},
};

/// Such that the number can be read again exactly.
std::string exact(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

void read_entry(const Entry& entry, ScannerIdentity& identity) {
    for (const TextField& field : text_fields) {
        if (entry.key == field.key) identity.*field.value = entry.value;
    }
    for (const NumberField& field : number_fields) {
        if (entry.key == field.key) identity.*field.value = parse_number(entry.value);
    }
    for (const StepField& field : step_fields) {
        const auto number = entry.key == field.key ? parse_number(entry.value) : std::nullopt;
        if (number && *number >= 0 && *number < 1e6)
            identity.*field.value = static_cast<int>(*number);
    }
    for (const AnswerField& field : answer_fields) {
        if (entry.key.starts_with(field.prefix))
            (identity.*field.value).push_back({entry.key.substr(field.prefix.size()), entry.value});
    }
}

}  // namespace

Entries entries_of(const ScannerIdentity& identity) {
    Entries entries;
    for (const TextField& field : text_fields) {
        const std::string& text = identity.*field.value;
        if (!text.empty()) entries.push_back({field.key, text});
    }
    for (const NumberField& field : number_fields) {
        if (const auto& number = identity.*field.value)
            entries.push_back({field.key, exact(*number)});
    }
    for (const StepField& field : step_fields) {
        if (const auto& step = identity.*field.value)
            entries.push_back({field.key, std::to_string(*step)});
    }
    for (const AnswerField& field : answer_fields) {
        for (const auto& [key, value] : identity.*field.value)
            entries.push_back({std::string(field.prefix) + key, value});
    }
    return entries;
}

ScannerIdentity identity_in(const Entries& entries) {
    ScannerIdentity identity;
    for (const Entry& entry : entries)
        read_entry(entry, identity);
    return identity;
}

}  // namespace scipd::sim
