// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_printed.h"

#include <optional>
#include <set>
#include <string_view>

namespace scipd::sim {
namespace {

/// What stands between two others; nothing where they are not there.
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

    /// "[PATH:FILE:L5]: XML Element[new], child of element[link], not defined in SDF. ..." as a
    /// sentence; empty where it was told, nothing where it is something else.
    std::optional<std::string> unknown_part(const std::string& text) {
        const auto element = between(text, "]: XML Element[", "], child of element[");
        const auto parent = between(text, "], child of element[", "], not defined in SDF");
        const auto attribute = between(text, "]: XML Attribute[", "] in element[");
        const auto owner = between(text, "] in element[", "] not defined in SDF");
        std::string what;
        if (element && parent) {
            what = '<' + *element + "> in <" + *parent + '>';
            // The kind of a geometry is told where it is missed.
            if (*parent == "geometry") return "";
        } else if (attribute && owner) {
            what = "the attribute " + *attribute + " of <" + *owner + '>';
        } else {
            return std::nullopt;
        }
        if (!told_.insert(what).second) return "";
        return place_in(text.substr(0, text.find("]: XML "))) + what +
               " is nothing that SDF 1.9 knows; ignored, here and elsewhere";
    }

    /// "<data-string>:L5" is in no file that anybody has.
    [[nodiscard]] std::string with_real_names(std::string text) const {
        for (const auto& [name, real] : stand_ins_) {
            const auto at = name.empty() ? text.npos : text.find(name + ":L");
            if (at != text.npos) text.replace(at, name.size(), real.file.string());
        }
        return text;
    }

  private:
    /// Of "PATH:FILE:L5".
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
    // It takes whatever is no good SDF for a robot.
    return printed.starts_with("Could not find the 'robot' element") ||
           printed.starts_with("Unable to call parseURDF on robot model") ||
           printed.starts_with("parse as old deprecated model file failed");
}

}  // namespace scipd::sim
