// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/stage/stage_file.h"

#include <stdexcept>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using Kind = StageToken::Kind;

constexpr int deepest_entity = 64;
constexpr std::size_t most_entities = 100'000;
/// Macros that use macros can expand a small file to any size.
constexpr std::size_t most_steps = 5'000'000;

class Parser {
  public:
    explicit Parser(const StageTokens& tokens) : tokens_(tokens) {}

    StageEntity parse() {
        StageEntity world;
        while (at_ < tokens_.all.size())
            take_statement(world);
        return world;
    }

  private:
    void take_statement(StageEntity& entity) {
        const StageToken& name = next("a word");
        if (name.kind != Kind::word) refuse(name, quote(name.text) + " stands where a word should");
        if (name.text == "define") return take_definition();
        const Kind kind = peek("the value or the bracket of " + quote(name.text)).kind;
        if (kind == Kind::open) {
            --at_;
            entity.children.push_back(take_entity());
        } else {
            entity.properties[name.text] = take_values(name);
        }
    }

    /// `define NAME TYPE ( ... )`: keeps where TYPE stands, and parses from there at each use.
    void take_definition() {
        const StageToken& name = next("the name of a definition");
        const std::size_t begin = at_;
        const StageToken& type = next("the type of a definition");
        if (name.kind != Kind::word || type.kind != Kind::word)
            refuse(name, "define wants a name, a type and brackets");
        if (next("a bracket").kind != Kind::open) refuse(type, "define wants brackets");
        for (int open = 1; open > 0;) {
            const Kind kind = next("a closing bracket").kind;
            open += kind == Kind::open ? 1 : (kind == Kind::close ? -1 : 0);
        }
        macros_.emplace(name.text, begin);  // the first definition counts
    }

    StageEntity take_entity() {
        const StageToken& type = next("a type");
        if (++entities_ > most_entities || ++depth_ > deepest_entity) {
            refuse(type, "has too many models, or too deep ones; does a definition use itself?");
        }
        StageEntity entity;
        if (const auto macro = macros_.find(type.text); macro != macros_.end()) {
            const std::size_t back = std::exchange(at_, macro->second);
            entity = take_entity();
            at_ = back;
        } else {
            entity.type = type.text;
        }
        entity.place = tokens_.place_of(type);
        ++at_;  // the bracket
        while (peek("a closing bracket").kind != Kind::close)
            take_statement(entity);
        ++at_;
        --depth_;
        return entity;
    }

    std::vector<std::string> take_values(const StageToken& name) {
        const StageToken& first = next("a value");
        if (first.kind == Kind::number || first.kind == Kind::text) return {first.text};
        if (first.kind != Kind::open_list) refuse(name, quote(name.text) + " has no value");
        std::vector<std::string> values;
        while (true) {
            const StageToken& token = next("a closing bracket");
            if (token.kind == Kind::close_list) return values;
            if (token.kind != Kind::number && token.kind != Kind::text)
                refuse(token, "a list holds numbers and texts, not " + quote(token.text));
            values.push_back(token.text);
        }
    }

    const StageToken& peek(const std::string& wanted) {
        if (at_ >= tokens_.all.size()) {
            throw LoadError(
                {tokens_.files.front().string() + ": ends where " + wanted + " should be"});
        }
        return tokens_.all[at_];
    }

    const StageToken& next(const char* wanted) {
        const StageToken& token = peek(wanted);
        if (++steps_ > most_steps) refuse(token, "its definitions expand to more than scipd reads");
        ++at_;
        return token;
    }

    [[noreturn]] void refuse(const StageToken& token, const std::string& why) const {
        throw LoadError({tokens_.place_of(token) + ": " + why});
    }

    const StageTokens& tokens_;
    std::size_t at_ = 0;
    std::map<std::string, std::size_t, std::less<>> macros_;
    std::size_t entities_ = 0;
    std::size_t steps_ = 0;
    int depth_ = 0;
};

}  // namespace

const std::vector<std::string>* StageEntity::find(std::string_view property) const {
    const auto found = properties.find(property);
    return found == properties.end() ? nullptr : &found->second;
}

std::string StageEntity::text(std::string_view property, const char* otherwise) const {
    const auto* values = find(property);
    return values == nullptr || values->empty() ? otherwise : values->front();
}

std::vector<double> StageEntity::numbers(std::string_view property) const {
    std::vector<double> all;
    const auto* values = find(property);
    if (values == nullptr) return all;
    for (const std::string_view value : *values) {
        const auto number = parse_number(value.substr(value.starts_with('+') ? 1 : 0));
        if (!number) {
            throw std::invalid_argument(std::string(property) + " must be numbers, not " +
                                        quote(value));
        }
        all.push_back(*number);
    }
    return all;
}

double StageEntity::number(std::string_view property, double otherwise) const {
    const auto all = numbers(property);
    return all.empty() ? otherwise : all.front();
}

StageFile parse_stage(const StageText& world, const FindInclude& find) {
    StageTokens tokens = stage_tokens(world, find);
    return {Parser{tokens}.parse(), std::move(tokens.warnings)};
}

}  // namespace scipd::sim
