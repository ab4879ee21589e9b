// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world that is known, and what the beams of a scanner meet in it. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/backends/range_backend.h"
#include "sim/world/material_library.h"
#include "tools/scipfit/noise_fit.h"
#include "tools/scipfit/sight.h"

namespace scipd::tools {

class KnownWorld {
  public:
    explicit KnownWorld(sim::SharedScene scene, sim::MaterialLibrary materials = {});

    /// What the beams that see something still meet first, if stations stand there.
    [[nodiscard]] Sights look(const Standing& standing, const std::vector<FlatPose>& places);

    /// A surface is called as its object is.
    [[nodiscard]] const std::string& name_of(std::size_t surface) const;
    /// How bright a surface is beside a white one, both met head-on, as the world says.
    [[nodiscard]] double brightness_of(std::size_t surface, int wavelength_nm) const;

  private:
    void look_from(const Standing& standing, std::size_t station, const FlatPose& place,
                   Sights& sights);

    std::unique_ptr<sim::RangeBackend> backend_;
    sim::MaterialLibrary materials_;
};

/// Throws WrongInput where the file is no world. `models`: where its models may be; `materials`: a
/// file of them, or empty.
[[nodiscard]] KnownWorld load_known_world(const std::filesystem::path& file,
                                          const std::vector<std::filesystem::path>& models,
                                          const std::filesystem::path& materials);

}  // namespace scipd::tools
