// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Maps small enough to check by hand, for tests: a YAML and a picture in a folder of their own, and
// probes that say what stands where.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/backends/registry.h"
#include "sim/loaders/map/ros_map.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {

/// Raw PGM; rows from the top.
std::string pgm(std::size_t width, const std::vector<int>& greys);

/// 8 bits a sample, written by stb_image_write; 1 to 4 channels.
std::string png(std::size_t width, int channels, const std::vector<int>& samples);

/// Whatever it is told: a header and deflated rows that need not fit it.
std::string odd_png(unsigned width, unsigned height, unsigned depth, unsigned colour,
                    const std::string& rows);

/// 24 bits a pixel, all three colours the same; a negative height puts the upper row first.
std::string bmp(int width, int height, const std::vector<int>& greys);

/// Little-endian, 8 bits a sample, in a strip for each row. `tags`: more that the header says, each
/// a number and a value of 16 bits.
std::string tiff(unsigned width, unsigned channels, const std::vector<int>& samples,
                 const std::vector<std::pair<int, int>>& tags);

/// A JPEG of the best quality, written by stb_image_write: blocks of 8 x 8 of one grey stay exact.
std::string jpeg(int width, const std::vector<int>& greys);

/// A YAML with everything that map_server wants, and `more`. One metre a pixel, from the origin.
std::string yaml(const std::string& image, const std::string& more = {});

class MapFolder {
  public:
    /// `text` is the YAML.
    LoadedScene load(const std::string& image, const std::string& picture, const std::string& text,
                     const MapOptions& options = {});

    [[nodiscard]] const tests::TempDir& folder() const { return folder_; }

  private:
    tests::TempDir folder_;
};

/// Casts single rays into a scene, in double.
class Probe {
  public:
    explicit Probe(SharedScene scene) : backend_(make_backend("reference", std::move(scene))) {}

    Hit cast(const glm::dvec3& from_m, const glm::dvec3& direction);

    /// z of what a ray from far above meets first, -1 where it meets nothing.
    float top_m(double x_m, double y_m);

    /// top_m() in the middles of cells of 1 m along y = 0.5, as the tests' maps of one row have
    /// them: '#' where there is something.
    std::string row(std::size_t cells);

  private:
    std::unique_ptr<RangeBackend> backend_;
};

}  // namespace scipd::sim
