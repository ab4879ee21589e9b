// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes files of large worlds for benchmarks, with the same bytes every time.
#pragma once

#include <filesystem>

namespace scipd::bench {

/// Writes hills of side x side squares, each of two triangles. The extension selects the format.
void write_terrain(const std::filesystem::path& file, int side);

enum class Clutter {
    none,
    /// As mapping leaves it: walls that are not along the axes, ragged edges, specks, unknown
    /// patches.
    noisy_and_turned,
};

/// Writes a storey of side x side cells of 5 cm: rooms of 6 m with doors and furniture, and unknown
/// space outside. Puts a PGM beside the YAML.
void write_map(const std::filesystem::path& file, int side, Clutter clutter);

}  // namespace scipd::bench
