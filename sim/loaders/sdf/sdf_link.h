// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the <link> of a model, with its surfaces and its sensors. What cannot be read is left out,
// and the draft told. One thread; one owner.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/parts/part.h"
#include "sim/loaders/sdf/sdf_geometry.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// Frames that stand for the sensors of the links of one model.
struct SensorFrames {
    std::vector<SdfPart> frames = {};
    std::set<std::string> names = {};
    std::set<std::string> links = {};  ///< all that were read
};

/// FILE:LINE: OUTER::NAME:, of an element that lies in `outer`.
std::string place_of(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
                     const std::vector<std::string>& outer, const std::string& name);

class LinkReader {
  public:
    /// `names`, of the model and those around it, are those at the time of each reading. All must
    /// outlive this object.
    LinkReader(SdfGeometry geometry, const std::vector<std::string>& names, SceneDraft& draft)
        : geometry_(geometry), names_(names), draft_(draft) {}

    std::optional<SdfPart> read(const tinyxml2::XMLElement& element, const SdfSheet& sheet,
                                SensorFrames& sensors);
    /// Adds the frame of a sensor of this link.
    void read_sensor(const tinyxml2::XMLElement& sensor, const std::string& link,
                     const SdfSheet& sheet, SensorFrames& sensors);

  private:
    std::vector<SdfSurface> read_surfaces(const tinyxml2::XMLElement& link, const std::string& name,
                                          const char* kind, const SdfSheet& sheet);
    void warn_of_sensor(const tinyxml2::XMLElement& sensor, const std::string& link,
                        const SdfSheet& sheet, const std::string& why);

    SdfGeometry geometry_;
    const std::vector<std::string>& names_;
    SceneDraft& draft_;
};

}  // namespace scipd::sim
