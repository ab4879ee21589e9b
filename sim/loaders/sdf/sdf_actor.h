// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An <actor> is, for example, a person who walks along a script. libsdformat gets it as a movable
// model whose skin is the visual of a link, so that its frames, links, includes and files work as
// in any model. The script is kept outside the document. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/script.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// The element that marks a model made from an actor. Its text is the index of the actor.
inline constexpr const char* actor_mark = "scipd:actor";
/// The name of the link that shows the skin, and of its visual.
inline constexpr std::string_view skin_name = "skin";
/// The URI of the skin of an actor without one.
inline constexpr const char* no_skin = "scipd:none";

struct SdfActor {
    Pose pose;                      ///< from its own element
    SharedScript script = nullptr;  ///< null: it stands still
};

/// Turns the actors of a document into models and adds them to `actors`. Returns warnings, each of
/// which begins with its place in `file`.
std::vector<std::string> take_actors(tinyxml2::XMLElement& root, const std::filesystem::path& file,
                                     std::vector<SdfActor>& actors);

}  // namespace scipd::sim
