// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/media.h"

#include <algorithm>
#include <charconv>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"
#include "sim/loaders/yaml/yaml_section.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::daemon {
namespace {

/// A number and its bounds.
struct MediumNumber {
    std::string_view key;
    double least;
    double most;
    std::string_view rule;
};

constexpr std::array<MediumNumber, 5> numbers{{
    {"visibility_m", 0.5, 100'000.0, "be 0.5 to 100000 m"},
    {"mm_per_hour", 0.0, 500.0, "be 0 to 500 mm an hour"},
    {"extinction_per_m", 0.0, 100.0, "be 0 to 100 a metre"},
    {"returns_per_m", 0.0, 1000.0, "be 0 to 1000 a metre"},
    {"brightness", 0.0, 10.0, "be 0 to 10"},
}};
constexpr std::array<std::string_view, 8> medium_keys{
    "kind",          "name",      "box", "visibility_m", "mm_per_hour", "extinction_per_m",
    "returns_per_m", "brightness"};
constexpr auto number_keys = std::span(medium_keys).subspan<3>();
constexpr auto custom_keys = number_keys.subspan<2>();
constexpr std::array<std::string_view, 2> box_keys{"from", "to"};

/// A kind of medium that one number tells all of.
struct MediumKind {
    std::string_view name;
    std::string_view amount_key;
    sim::Medium (*make)(double amount);
};

constexpr std::array<MediumKind, 4> kinds{{
    {"fog", "visibility_m", sim::fog},
    {"rain", "mm_per_hour", sim::rain},
    {"snow", "mm_per_hour", sim::snow},
    {"dust", "visibility_m", sim::dust},
}};

const MediumKind* find_kind(std::string_view name) {
    const auto* const found = std::ranges::find(kinds, name, &MediumKind::name);
    return found == kinds.end() ? nullptr : found;
}

std::string shortest(double value) {
    std::array<char, 32> digits{};
    return {digits.begin(), std::to_chars(digits.begin(), digits.end(), value).ptr};
}

void check_bounds(const MediumRequest& request, const TellFault& tell) {
    for (const auto& [key, least, most, rule] : numbers) {
        const auto given = request.numbers.find(key);
        if (given == request.numbers.end()) continue;
        if (given->second >= least && given->second <= most) continue;
        tell(key, "must " + std::string(rule) + ", not " + sim::quote(shortest(given->second)));
    }
}

/// Whether a medium of this kind has the numbers that it needs, and no others.
void check_numbers(const MediumRequest& request, std::span<const std::string_view> its_own,
                   const TellFault& tell) {
    for (const auto& [key, value] : request.numbers) {
        if (std::ranges::find(its_own, key) != its_own.end()) continue;
        tell(key, "is not of " + request.kind + "; leave it out");
    }
    if (!request.numbers.contains(its_own.front()))
        tell({}, "needs " + std::string(its_own.front()));
    check_bounds(request, tell);
}

double number_of(const MediumRequest& request, std::string_view key) {
    const auto given = request.numbers.find(key);
    return given == request.numbers.end() ? 0.0 : given->second;
}

/// Without its name and its box.
sim::Medium matter_of(const MediumRequest& request, const TellFault& tell) {
    if (const MediumKind* const kind = find_kind(request.kind)) {
        check_numbers(request, {&kind->amount_key, 1}, tell);
        return kind->make(number_of(request, kind->amount_key));
    }
    if (request.kind == "custom") {
        check_numbers(request, custom_keys, tell);
    } else if (request.kind.empty()) {
        tell({}, "needs kind: fog, rain, snow, dust or custom");
    } else {
        tell("kind", "must be fog, rain, snow, dust or custom, not " + sim::quote(request.kind));
    }
    return {.extinction_per_m = number_of(request, "extinction_per_m"),
            .returns_per_m = number_of(request, "returns_per_m"),
            .brightness = number_of(request, "brightness")};
}

void put_into_box(const std::array<glm::dvec3, 2>& box_m, sim::Medium& medium,
                  const TellFault& tell) {
    medium.low_m = box_m[0];
    medium.high_m = box_m[1];
    for (int axis = 0; axis < 3; ++axis) {
        if (medium.low_m[axis] < medium.high_m[axis]) continue;
        return tell("box", "must go from the lowest corner to the highest in x, y and z");
    }
}

void give_name(const MediumRequest& request, const std::vector<sim::Medium>& others,
               sim::Medium& medium, const TellFault& tell) {
    medium.name = request.name.empty() ? request.kind : request.name;
    if (medium.name.empty()) return;
    if (const auto checked = sim::check_name(medium.name); !checked)
        return tell("name", checked.error().why);
    if (std::ranges::find(others, medium.name, &sim::Medium::name) == others.end()) return;
    const std::string key = request.name.empty() ? "" : "name";
    tell(key, (key.empty() ? "needs a name, since another medium is " : "is taken: another is ") +
                  sim::quote(medium.name));
}

void read_number(const sim::YamlField& field, MediumRequest& request, sim::YamlFaults& faults) {
    const auto number = sim::text_of(field.value).and_then([](const std::string& text) {
        const auto value = sim::parse_number(text);
        return value ? sim::Expected<double>(*value)
                     : sim::refuse("must be a number, not " + sim::quote(text));
    });
    faults.take(field, number, request.numbers[field.key]);
}

void read_box(const sim::YamlField& field, MediumRequest& request, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, box_keys, faults,
                                   "box: {from: [0, 0, 0], to: [3, 2, 2.5]}"};
    auto& corners_m = request.box_m.emplace();
    for (std::size_t i = 0; i < box_keys.size(); ++i) {
        section.read_vector(box_keys[i], corners_m[i], parse_metres);
        if (field.value.IsMap() && section.find(box_keys[i]) == nullptr)
            faults.add(field, "needs " + std::string(box_keys[i]));
    }
}

MediumRequest read_request(const sim::YamlSection& section, sim::YamlFaults& faults) {
    MediumRequest request;
    section.read("kind", request.kind);
    section.read("name", request.name);
    for (const std::string_view key : number_keys) {
        if (const sim::YamlField* const field = section.find(key))
            read_number(*field, request, faults);
    }
    if (const sim::YamlField* const box = section.find("box")) read_box(*box, request, faults);
    return request;
}

}  // namespace

std::span<const std::string_view> medium_numbers() {
    return number_keys;
}

std::string_view amount_key(std::string_view kind) {
    const MediumKind* const found = find_kind(kind);
    return found == nullptr ? std::string_view{} : found->amount_key;
}

void add_medium(const MediumRequest& request, std::vector<sim::Medium>& media,
                const TellFault& tell) {
    bool faulty = false;
    const TellFault note = [&](std::string_view key, const std::string& why) {
        faulty = true;
        tell(key, why);
    };
    sim::Medium medium = matter_of(request, note);
    give_name(request, media, medium, note);
    if (request.box_m) put_into_box(*request.box_m, medium, note);
    if (!faulty) media.push_back(std::move(medium));
}

std::vector<sim::Medium> read_media(const sim::YamlField& list, sim::YamlFaults& faults) {
    static_assert(most_media == longest_list);
    std::vector<sim::YamlField> fields;
    faults.take(list, items(list), fields);
    std::vector<sim::Medium> media;
    for (const sim::YamlField& field : fields) {
        const std::size_t before = faults.count();
        const sim::YamlSection section{field, medium_keys, faults};
        const MediumRequest request = read_request(section, faults);
        if (faults.count() != before) continue;
        add_medium(request, media, [&](std::string_view key, const std::string& why) {
            const sim::YamlField* const at = section.find(key);
            faults.add(at != nullptr ? *at : field, why);
        });
    }
    return media;
}

}  // namespace scipd::daemon
