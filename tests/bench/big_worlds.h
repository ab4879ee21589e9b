// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files of large worlds, for benchmarks: the same bytes every time.
#pragma once

#include <filesystem>

namespace scipd::bench {

/// Hills of side x side squares of two triangles each; the extension tells the format.
void write_terrain(const std::filesystem::path& file, int side);

enum class Clutter {
    none,
    /// As mapping leaves it: no wall along the axes, ragged edges, specks, unknown patches.
    noisy_and_turned,
};

/// A storey of side x side cells of 5 cm: rooms of 6 m with doors and furniture, unknown outside.
/// Writes a PGM beside the YAML.
void write_map(const std::filesystem::path& file, int side, Clutter clutter);

}  // namespace scipd::bench
