// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/parts/part_names.h"

#include <functional>
#include <map>
#include <set>

namespace scipd::sim {
namespace {

/// Mends one group of names, in their order.
class Names {
  public:
    Names(const std::vector<std::string>& outer, SceneDraft& draft)
        : outer_(outer), draft_(draft) {}

    void take(const std::string& name) { taken_.insert(name); }

    /// A name for what is called `name`.
    std::string mended(const std::string& name, const std::string& kind, const FilePlace& place) {
        const bool is_first = seen_.insert(name).second;
        if (!name.empty() && is_first) return name;
        std::string better = free_name(name.empty() ? kind : name);
        const std::string path = path_of(outer_);
        draft_.warn(text_of(place) + ": " +
                    (name.empty() ? "a " + kind + " has no name"
                                  : "there is another " + kind + ' ' +
                                        (path.empty() ? "" : path + "::") + name) +
                    "; this one is called " + better);
        return better;
    }

    /// Roads may have no name, or all the same one.
    std::string of_road(const std::string& name) {
        const std::string wanted = name.empty() || name.starts_with("__") ? "road" : name;
        std::string free = wanted;
        for (std::size_t& count = roads_[wanted]; !taken_.insert(free).second; ++count)
            free = wanted + '_' + std::to_string(count + 2);
        return free;
    }

  private:
    [[nodiscard]] std::string free_name(const std::string& name) {
        // Where many have one name, each begins to count where the last one stopped: so no two get
        // the same, and nobody needs to keep what was given.
        for (std::size_t& i = next_[name];;) {
            std::string candidate = name + '_' + std::to_string(i++);
            if (!taken_.contains(candidate)) return candidate;
        }
    }

    const std::vector<std::string>& outer_;
    SceneDraft& draft_;
    std::set<std::string, std::less<>> taken_;
    std::set<std::string, std::less<>> seen_;
    std::map<std::string, std::size_t> next_;
    std::map<std::string, std::size_t> roads_;  ///< how many have this name
};

std::string kind_of(const SdfPart& part) {
    switch (part.kind) {
        case SdfPart::Kind::world:
            return "world";
        case SdfPart::Kind::model:
            return "model";
        case SdfPart::Kind::link:
            return "link";
        case SdfPart::Kind::frame:
            return "frame";
        case SdfPart::Kind::joint:
            break;
    }
    return "joint";
}

}  // namespace

std::string path_of(const std::vector<std::string>& names) {
    std::string path;
    for (const std::string& name : names)
        path += (path.empty() ? "" : "::") + name;
    return path;
}

void mend_names(std::vector<SdfPart>& parts, const std::vector<std::string>& outer,
                SceneDraft& draft) {
    Names names(outer, draft);
    for (const SdfPart& part : parts) {
        if (!part.is_road) names.take(part.name);
    }
    for (SdfPart& part : parts) {
        if (part.is_road) {
            part.name = names.of_road(part.name);
            continue;
        }
        // Nobody asks for the names of joints, and a sensor has that of its link in it.
        const bool is_quiet = part.kind == SdfPart::Kind::joint && part.name.empty();
        if (!is_quiet && !part.sensor) {
            part.name = names.mended(part.name, kind_of(part), part.place);
        }
    }
}

void mend_names(std::vector<SdfSurface>& surfaces, const std::vector<std::string>& outer,
                const std::string& kind, SceneDraft& draft) {
    Names names(outer, draft);
    for (const SdfSurface& surface : surfaces)
        names.take(surface.name);
    for (SdfSurface& surface : surfaces)
        surface.name = names.mended(surface.name, kind, surface.place);
}

}  // namespace scipd::sim
