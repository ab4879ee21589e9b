// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads an SDF or URDF document, and all that it includes, into a tree of parts. What no range
// depends on is not looked at. What a scanner would see and cannot be read is left out, and the
// draft told. One thread; one owner.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_documents.h"
#include "sim/loaders/sdf/sdf_link.h"
#include "sim/loaders/sdf/sdf_state.h"

namespace scipd::sim {

struct SdfTree {
    SdfPart root;    ///< a world; around a model alone, one of the same name
    SdfState state;  ///< of the world
};

class SdfReader {
  public:
    /// What it gets must outlive it.
    SdfReader(const Resources& resources, const SdfOptions& options, SceneDraft& draft)
        : options_(options), draft_(draft), documents_(resources, options, draft) {}

    /// Throws LoadError.
    SdfTree read(const SdfSource& source);

  private:
    SdfTree read_world(const tinyxml2::XMLElement& root, const SdfSheet& sheet);
    /// The first model of a document, called `name` if that is not empty; nothing if it has none.
    std::optional<SdfPart> model_in(const SdfDocument& document, const std::string& name);
    std::optional<SdfPart> read_robot(const tinyxml2::XMLElement& robot, const SdfSheet& sheet,
                                      const std::string& name);
    std::optional<SdfPart> read_model(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
                                      const std::string& name);
    void read_own_pose(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& robot);
    /// For a model, a robot or an include; where it says nothing, what is known already stays.
    void read_static(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& model);
    void read_actor(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& model);
    [[nodiscard]] SdfPart as_seen(SdfPart link) const;
    void read_parts(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& outer);
    void read_part(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& outer,
                   SensorFrames& sensors);
    void read_link(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& outer,
                   SensorFrames& sensors);
    void read_population(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
                         SdfPart& world);
    void read_frame(const tinyxml2::XMLElement& element, const SdfSheet& sheet, SdfPart& outer);
    void read_include(const tinyxml2::XMLElement& include, const SdfSheet& sheet, SdfPart& outer);
    void place_include(const tinyxml2::XMLElement& include, const SdfSheet& sheet, SdfPart& model);
    const SdfDocument* document_of(const tinyxml2::XMLElement& include, const SdfSheet& sheet);
    bool enter(const SdfDocument& document, const std::string& place);

    /// Counts the memory of so many more parts. Throws LoadError if a world takes too much.
    void count_parts(std::size_t count);
    void name_apart(std::vector<SdfPart>& parts);

    const SdfOptions& options_;
    SceneDraft& draft_;
    SdfDocuments documents_;
    std::string source_;
    std::vector<const SdfDocument*> open_;  ///< the one being read, after those that include it
    std::vector<std::string> names_;        ///< of the model being read, after those around it
    LinkReader links_{options_.geometry, names_, draft_};
    std::size_t parts_ = 0;
};

}  // namespace scipd::sim
