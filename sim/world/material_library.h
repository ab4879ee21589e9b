// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is known of materials by their names, and the surface (surface.h) that follows from it and
// from what a world says. docs/materials.md tells the rules. Values; any thread.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/material.h"
#include "sim/world/surface.h"

namespace scipd::sim {

/// What the library knows of one material.
struct MaterialOptics {
    std::string name;
    std::vector<std::string> aliases;   ///< other names that worlds use for it
    std::map<int, double> reflectance;  ///< by wavelength in nm: diffuse and specular together
    double specular = 0.0;              ///< the share of the reflectance that is mirror-like
    // The rest as in Surface.
    double gloss = 1.0;
    double retro = 0.0;
    double transmission = 0.0;
    double roughness = 0.0;
    double texture = 0.0;

    std::string source;       ///< where the numbers come from; empty: from nowhere
    std::size_t numbers = 0;  ///< how many of the above were given
    std::size_t assumed = 0;  ///< how many of these have no source
};

class MaterialLibrary {
  public:
    /// One that has the name or an alias of an earlier one takes that name from it. One of the same
    /// name takes its place: aliases of the earlier one then mean the new one.
    void add(MaterialOptics material);

    /// By its name or an alias, in whatever case; null where there is none.
    [[nodiscard]] const MaterialOptics* find(std::string_view name) const;

    /// What a material of a scene does with light of this wavelength. Between two wavelengths the
    /// reflectance is interpolated linearly; beyond the outermost it stays.
    ///
    /// A name that is known counts. Where it is not, or means "default", the appearance counts, on
    /// a face that is else like "default". A laser_retro above 0 counts in both cases, for how
    /// bright the face is: up to 1 it is the reflectance, above that the face sends back so many
    /// times as much as a white one.
    [[nodiscard]] Surface surface(const Material& material, int wavelength_nm) const;

    [[nodiscard]] const std::vector<MaterialOptics>& materials() const { return materials_; }
    /// How many numbers all entries give, and how many of them have no source.
    [[nodiscard]] std::size_t numbers() const;
    [[nodiscard]] std::size_t assumed() const;

  private:
    std::vector<MaterialOptics> materials_;
    std::map<std::string, std::size_t> index_of_;  ///< by names and aliases, in lower case
};

using SharedMaterials = std::shared_ptr<const MaterialLibrary>;

/// Names of materials mean the same in whatever case: this one.
std::string in_lower_case(std::string_view name);

}  // namespace scipd::sim
