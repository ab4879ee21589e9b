// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_printed.h"

#include <optional>
#include <set>
#include <string_view>

namespace scipd::sim {
namespace {

/// The text between `before` and `behind`; nothing if either is missing.
std::optional<std::string> between(std::string_view text, std::string_view before,
                                   std::string_view behind) {
    const auto begin = text.find(before);
    if (begin == text.npos) return std::nullopt;
    text.remove_prefix(begin + before.size());
    const auto end = text.find(behind);
    return end == text.npos ? std::nullopt : std::optional{std::string{text.substr(0, end)}};
}

class Rewording {
  public:
    explicit Rewording(const std::map<std::string, StandIn>& stand_ins) : stand_ins_(stand_ins) {}

    /// Turns "[PATH:FILE:L5]: XML Element[new], child of element[link], not defined in SDF. ..."
    /// into a sentence. Empty if it was reported before; nothing if the text is another message.
    std::optional<std::string> unknown_part(const std::string& text) {
        const auto element = between(text, "]: XML Element[", "], child of element[");
        const auto parent = between(text, "], child of element[", "], not defined in SDF");
        const auto attribute = between(text, "]: XML Attribute[", "] in element[");
        const auto owner = between(text, "] in element[", "] not defined in SDF");
        std::string what;
        if (element && parent) {
            what = '<' + *element + "> in <" + *parent + '>';
            // Another warning reports the unknown geometry itself.
            if (*parent == "geometry") return "";
        } else if (attribute && owner) {
            what = "the attribute " + *attribute + " of <" + *owner + '>';
        } else {
            return std::nullopt;
        }
        if (!told_.insert(what).second) return "";
        return place_in(text.substr(0, text.find("]: XML "))) + what +
               " is not part of SDF 1.9; ignored, here and elsewhere";
    }

    /// Replaces names such as "<data-string>:L5", which the user does not know.
    [[nodiscard]] std::string with_real_names(std::string text) const {
        for (const auto& [name, real] : stand_ins_) {
            const auto at = name.empty() ? text.npos : text.find(name + ":L");
            if (at != text.npos) text.replace(at, name.size(), real.file.string());
        }
        return text;
    }

  private:
    /// FILE:LINE for the user, from "PATH:FILE:L5".
    [[nodiscard]] std::string place_in(const std::string& text) const {
        const auto line = text.rfind(":L");
        if (line == text.npos) return "";
        for (const auto& [name, real] : stand_ins_) {
            if (name.empty() || !std::string_view{text}.substr(0, line).ends_with(':' + name)) {
                continue;
            }
            return real.file.string() + (real.same_lines ? ':' + text.substr(line + 2) : "") + ": ";
        }
        return "";
    }

    const std::map<std::string, StandIn>& stand_ins_;
    std::set<std::string> told_;
};

}  // namespace

std::vector<std::string> in_plain_words(const std::vector<std::string>& printed,
                                        const std::map<std::string, StandIn>& stand_ins,
                                        const std::filesystem::path& file) {
    Rewording rewording{stand_ins};
    std::vector<std::string> sentences;
    for (const auto& text : printed) {
        const auto unknown = rewording.unknown_part(text);
        if (!unknown) {
            sentences.push_back(file.string() + ": " + rewording.with_real_names(text));
        } else if (!unknown->empty()) {
            sentences.push_back(*unknown);
        }
    }
    return sentences;
}

bool is_printed_echo(const std::string& printed) {
    // The library tries to read every faulty SDF as a robot, and then prints these.
    return printed.starts_with("Could not find the 'robot' element") ||
           printed.starts_with("Unable to call parseURDF on robot model") ||
           printed.starts_with("parse as old deprecated model file failed");
}

}  // namespace scipd::sim
