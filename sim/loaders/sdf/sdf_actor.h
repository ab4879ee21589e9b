// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// <actor>: a person, say, who walks by a script. To libsdformat it becomes a movable model whose
// skin is the visual of a link, so that its frames, links, includes and files are those of any
// model; where it walks is kept beside the document. Any thread; nothing shared.
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

/// What a model that was an actor says of itself: its place among the actors.
inline constexpr const char* actor_mark = "scipd:actor";
/// The link that shows the skin, and its visual.
inline constexpr std::string_view skin_name = "skin";
/// The file of a skin where there is none.
inline constexpr const char* no_skin = "scipd:none";

struct SdfActor {
    Pose pose;                      ///< that its own element gives
    SharedScript script = nullptr;  ///< null: it stands
};

/// Makes models of the actors of a document, adds them to `actors`, and answers with what is to be
/// told of them, each with its place in `file`.
std::vector<std::string> take_actors(tinyxml2::XMLElement& root, const std::filesystem::path& file,
                                     std::vector<SdfActor>& actors);

}  // namespace scipd::sim
