// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/materials/materials_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/yaml/yaml_document.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

constexpr std::size_t largest_materials_file = 1 << 20;
constexpr std::size_t longest_material = 200;
constexpr int shortest_nm = 300;
constexpr int longest_nm = 2000;

/// A key of an entry that is one number.
struct NumberKey {
    using Target = double MaterialOptics::*;
    std::string_view key;
    Target target;
    double low;
    double high;
    const char* advice;
};

constexpr const char* share_advice = "must be a share from 0 to 1";
constexpr std::array<NumberKey, 6> number_keys{
    {{"specular", &MaterialOptics::specular, 0.0, 1.0, share_advice},
     {"gloss", &MaterialOptics::gloss, 1.0, 1e6, "must be an exponent from 1 to 1e6"},
     {"retro", &MaterialOptics::retro, 0.0, 1.0, share_advice},
     {"transmission", &MaterialOptics::transmission, 0.0, 1.0, share_advice},
     {"roughness", &MaterialOptics::roughness, 0.0, 1.57, "must be an angle in rad, 0 to 1.57"},
     {"texture", &MaterialOptics::texture, 0.0, 1.0, share_advice}}};

std::optional<double> number_of(const YAML::Node& node) {
    return node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
}

std::optional<int> wavelength_of(std::string_view text) {
    const auto number = parse_number(text);
    if (!number || *number != std::floor(*number)) return std::nullopt;
    if (*number < shortest_nm || *number > longest_nm) return std::nullopt;
    return static_cast<int>(*number);
}

/// Which numbers of an entry have no source.
struct Assumed {
    bool all = false;
    std::set<std::string, std::less<>> keys;  ///< of the entry
    std::set<int> wavelengths_nm;

    [[nodiscard]] bool has(std::string_view key) const { return all || keys.contains(key); }
    [[nodiscard]] bool has(int wavelength_nm) const {
        return has("reflectance") || wavelengths_nm.contains(wavelength_nm);
    }
};

class MaterialsReader {
  public:
    explicit MaterialsReader(YamlFaults& faults) : faults_(faults) {}

    std::vector<MaterialOptics> read(const YamlField& document);

  private:
    /// Those of a map that has some. What is none gets the fault `otherwise`.
    std::vector<YamlField> entries_of(const YamlField& map, const char* otherwise);
    std::vector<std::string> texts_of(const YamlField& list, const char* otherwise);
    MaterialOptics read_entry(const YamlField& entry);
    void read_key(const YamlField& field, MaterialOptics& material, Assumed& assumed);
    void read_reflectance(const YamlField& field, MaterialOptics& material);
    void read_assumed(const YamlField& field, Assumed& assumed);
    void read_aliases(const YamlField& field, MaterialOptics& material);
    void check_energy(const YamlField& entry, const MaterialOptics& material);
    void count_numbers(const YamlField& entry, const Assumed& assumed, MaterialOptics& material);
    /// Notes that the name is taken.
    void claim(const YamlField& field, const std::string& name);

    YamlFaults& faults_;
    std::map<std::string, int> line_of_;  ///< names and aliases, in lower case
};

std::vector<YamlField> MaterialsReader::entries_of(const YamlField& map, const char* otherwise) {
    if (map.value.IsMap() && map.value.size() > 0) return entries(map, faults_);
    faults_.add(map, otherwise);
    return {};
}

std::vector<std::string> MaterialsReader::texts_of(const YamlField& list, const char* otherwise) {
    std::vector<std::string> texts;
    if (list.value.IsSequence()) {
        for (const YAML::Node& item : list.value) {
            if (item.IsScalar()) texts.push_back(item.Scalar());
        }
    }
    if (!list.value.IsSequence() || texts.size() != list.value.size()) faults_.add(list, otherwise);
    return texts;
}

void MaterialsReader::claim(const YamlField& field, const std::string& name) {
    if (name.empty() || name.size() > longest_material) {
        return faults_.add(field, "a name must have 1 to 200 bytes");
    }
    const auto [first, is_new] = line_of_.emplace(in_lower_case(name), field.line);
    if (is_new) return;
    faults_.add(field, "the name " + quote(name, longest_material) + " is taken in line " +
                           std::to_string(first->second) + "; use another (case does not count)");
}

void MaterialsReader::read_reflectance(const YamlField& field, MaterialOptics& material) {
    constexpr auto wanted =
        "must be a map of wavelengths in nm and shares, such as {785: 0.9, 905: 0.88}";
    for (const YamlField& one : entries_of(field, wanted)) {
        const auto wavelength_nm = wavelength_of(one.key);
        const auto reflectance = number_of(one.value);
        if (!wavelength_nm) {
            faults_.add(one, "must be a wavelength in whole nm, 300 to 2000");
        } else if (!reflectance || !(*reflectance >= 0.0 && *reflectance <= 1.0)) {
            faults_.add(one, share_advice);
        } else {
            material.reflectance[*wavelength_nm] = *reflectance;
        }
    }
}

void MaterialsReader::read_assumed(const YamlField& field, Assumed& assumed) {
    constexpr auto wanted =
        "must be true, or a list of keys and wavelengths of this entry whose numbers have no "
        "source, such as [905, gloss]";
    if (field.value.IsScalar()) {
        assumed.all = field.value.Scalar() == "true";
        if (!assumed.all) faults_.add(field, wanted);
        return;
    }
    for (const std::string& text : texts_of(field, wanted)) {
        const auto wavelength_nm = wavelength_of(text);
        const bool is_key = text == "reflectance" || std::ranges::any_of(number_keys, [&](auto& n) {
                                return n.key == text;
                            });
        if (is_key) {
            assumed.keys.insert(text);
        } else if (wavelength_nm) {
            assumed.wavelengths_nm.insert(*wavelength_nm);
        } else {
            faults_.add(field, quote(text) + " is no key with a number and no wavelength");
        }
    }
}

void MaterialsReader::read_aliases(const YamlField& field, MaterialOptics& material) {
    material.aliases = texts_of(field, "must be a list of names, such as [Gazebo/Wood]");
    for (const std::string& alias : material.aliases)
        claim(field, alias);
}

void MaterialsReader::read_key(const YamlField& field, MaterialOptics& material, Assumed& assumed) {
    if (field.key == "reflectance") return read_reflectance(field, material);
    if (field.key == "assumed") return read_assumed(field, assumed);
    if (field.key == "aliases") return read_aliases(field, material);
    if (field.key == "source") {
        if (field.value.IsScalar()) material.source = field.value.Scalar();
        if (material.source.empty()) faults_.add(field, "must say where the numbers come from");
        return;
    }
    const auto* const known = std::ranges::find(number_keys, field.key, &NumberKey::key);
    if (known == number_keys.end()) {
        return faults_.add(field,
                           "unknown key; known here are reflectance, specular, gloss, retro, "
                           "transmission, roughness, texture, source, assumed, aliases");
    }
    const auto number = number_of(field.value);
    if (!number || !(*number >= known->low && *number <= known->high)) {
        return faults_.add(field, known->advice);
    }
    material.*known->target = *number;
}

void MaterialsReader::check_energy(const YamlField& entry, const MaterialOptics& material) {
    constexpr double rounding = 1e-9;
    for (const auto& [wavelength_nm, reflectance] : material.reflectance) {
        const double all = reflectance + material.retro + material.transmission;
        if (all <= 1.0 + rounding) continue;
        faults_.add(entry, "reflectance, retro and transmission are " +
                               printable(std::to_string(all).substr(0, 5)) + " together at " +
                               std::to_string(wavelength_nm) +
                               " nm; no face gives back more than falls on it, so keep to 1");
    }
}

void MaterialsReader::count_numbers(const YamlField& entry, const Assumed& assumed,
                                    MaterialOptics& material) {
    for (const auto& [wavelength_nm, reflectance] : material.reflectance) {
        ++material.numbers;
        if (assumed.has(wavelength_nm)) ++material.assumed;
    }
    for (const NumberKey& number : number_keys) {
        if (!entry.value[std::string(number.key)].IsDefined()) continue;
        ++material.numbers;
        if (assumed.has(number.key)) ++material.assumed;
    }
    if (!material.source.empty() || material.assumed == material.numbers) return;
    faults_.add(entry,
                "needs a source that says where its numbers come from; those without one must be "
                "listed under assumed (assumed: true is all of them)");
}

MaterialOptics MaterialsReader::read_entry(const YamlField& entry) {
    MaterialOptics material;
    material.name = entry.key;
    Assumed assumed;
    const std::size_t sound = faults_.count();
    for (const YamlField& field : entries_of(entry, "must be a map with reflectance and more"))
        read_key(field, material, assumed);
    if (faults_.count() != sound) return material;
    if (material.reflectance.empty()) faults_.add(entry, "needs a reflectance");
    check_energy(entry, material);
    count_numbers(entry, assumed, material);
    return material;
}

std::vector<MaterialOptics> MaterialsReader::read(const YamlField& document) {
    constexpr auto wanted =
        "is no library of materials, which has `materials: {NAME: {reflectance: {905: 0.5}, "
        "assumed: true}}`";
    std::vector<MaterialOptics> materials;
    for (const YamlField& root : entries_of(document, wanted)) {
        if (root.key != "materials") {
            faults_.add(root, "unknown key; known here is materials");
            continue;
        }
        const auto all = entries_of(root, "must be a map of 1 to 4096 names and what they mean");
        for (const YamlField& entry : all)
            claim(entry, entry.key);
        for (const YamlField& entry : all)
            materials.push_back(read_entry(entry));
    }
    faults_.throw_if_any();
    return materials;
}

constexpr std::size_t most_unknown_told = 100;

void note_hints(const Material& material, std::set<std::string>& hints) {
    if (material.laser_retro.value_or(0.0) > 0.0) hints.insert("laser_retro");
    if (material.appearance.transparency) hints.insert("transparency");
    if (material.appearance.metalness) hints.insert("metalness");
}

/// The materials that a scene uses and the library does not know.
std::vector<const Material*> unknown_to(const MaterialLibrary& library, const Scene& scene) {
    std::set<MaterialId> used;
    for (const Object& object : scene.objects)
        used.insert(object.material);
    std::vector<const Material*> unknown;
    for (const MaterialId id : used) {
        const Material& material = scene.materials[id];
        const bool is_named = material.name != scene.materials.front().name;
        if (is_named && library.find(material.name) == nullptr) unknown.push_back(&material);
    }
    return unknown;
}

std::string taken_as(const std::set<std::string>& hints) {
    std::string text;
    for (const std::string& hint : hints)
        text += (text.empty() ? "" : " and ") + hint;
    return text.empty() ? "like an unnamed one" : "by its " + text;
}

}  // namespace

std::vector<MaterialOptics> parse_materials(const std::string& text,
                                            const std::filesystem::path& file) {
    YamlFaults faults{file.string()};
    const YamlField whole{.value = parse_yaml(text, "a library of materials", faults)};
    return MaterialsReader{faults}.read(whole);
}

std::vector<MaterialOptics> load_materials(const std::filesystem::path& file) {
    return parse_materials(
        read_text(file, largest_materials_file, "name a library of materials of at most 1 MiB"),
        file);
}

std::vector<std::string> unknown_materials(const Scene& scene, const MaterialLibrary& library,
                                           const std::string& source) {
    std::map<std::string, std::set<std::string>> hints_of;
    for (const Material* material : unknown_to(library, scene))
        note_hints(*material, hints_of[material->name]);
    std::vector<std::string> warnings;
    for (const auto& [name, hints] : hints_of) {
        if (warnings.size() == most_unknown_told) {
            warnings.push_back(source + ": " + std::to_string(hints_of.size() - warnings.size()) +
                               " more names of materials are unknown");
            break;
        }
        warnings.push_back(source + ": no library knows the material " + quote(name, 64) +
                           ", which is taken " + taken_as(hints) +
                           "; describe it in a file that the configuration names under materials");
    }
    return warnings;
}

bool names_unknown(const Scene& scene, const MaterialLibrary& library) {
    const auto unknown = unknown_to(library, scene);
    return !std::ranges::all_of(unknown, &Material::from_script);
}

}  // namespace scipd::sim
