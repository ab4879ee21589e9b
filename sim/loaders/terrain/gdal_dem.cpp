// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The only file that calls GDAL, with only those drivers that open nothing but the file and its
// neighbours in the same folder. The heights are those that gz-common 5 makes of the file (Dem.cc).
#include "sim/loaders/terrain/gdal_dem.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include <cpl_error.h>
#include <gdal.h>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <ogr_srs_api.h>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {
namespace {

constexpr std::array<const char*, 7> drivers{"GTiff",   "AAIGrid", "DTED", "EHdr",
                                             "SRTMHGT", "USGSDEM", nullptr};

struct Close {
    void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, Close>;

[[noreturn]] void refuse_terrain(const std::string& why) {
    const std::string said = CPLGetLastErrorMsg();
    throw std::runtime_error(why + (said.empty() ? "" : ": " + said));
}

Dataset open(const std::filesystem::path& file) {
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    Dataset dataset{GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(),
                               nullptr, nullptr)};
    if (dataset == nullptr)
        refuse_terrain("is neither a picture nor an elevation model in a known format");
    if (const int bands = GDALGetRasterCount(dataset.get()); bands != 1) {
        refuse_terrain("has " + std::to_string(bands) + " bands; an elevation model has one");
    }
    return dataset;
}

/// Longitude and latitude of pixels, if the file says where on Earth it lies.
class Globe {
  public:
    explicit Globe(GDALDatasetH dataset) {
        const char* projection = GDALGetProjectionRef(dataset);
        if (projection == nullptr || *projection == '\0') return;
        if (GDALGetGeoTransform(dataset, transform_.data()) != CE_None) return;
        from_.reset(OSRNewSpatialReference(projection));
        to_.reset(OSRNewSpatialReference(nullptr));
        OSRSetWellKnownGeogCS(to_.get(), "WGS84");
        OSRSetAxisMappingStrategy(from_.get(), OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(to_.get(), OAMS_TRADITIONAL_GIS_ORDER);
        turn_.reset(OCTNewCoordinateTransformation(from_.get(), to_.get()));
    }

    [[nodiscard]] std::optional<glm::dvec2> at(double x, double y) const {
        if (turn_ == nullptr) return {};
        glm::dvec2 place{transform_[0] + x * transform_[1] + y * transform_[2],
                         transform_[3] + x * transform_[4] + y * transform_[5]};
        if (OCTTransform(turn_.get(), 1, &place.x, &place.y, nullptr) == 0) return {};
        return glm::radians(place);
    }

  private:
    struct Destroy {
        void operator()(void* reference) const { OSRDestroySpatialReference(reference); }
    };
    struct DestroyTurn {
        void operator()(OGRCoordinateTransformationH turn) const {
            OCTDestroyCoordinateTransformation(turn);
        }
    };
    std::array<double, 6> transform_{};
    std::unique_ptr<void, Destroy> from_;
    std::unique_ptr<void, Destroy> to_;
    std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, DestroyTurn> turn_;
};

/// Along a great circle, on the sphere that gz-math uses.
double distance_m(const glm::dvec2& a_rad, const glm::dvec2& b_rad) {
    constexpr double earth_radius_m = 6'371'000.0;
    const glm::dvec2 half = 0.5 * (b_rad - a_rad);
    const double share = std::pow(std::sin(half.y), 2) +
                         std::cos(a_rad.y) * std::cos(b_rad.y) * std::pow(std::sin(half.x), 2);
    return 2.0 * earth_radius_m * std::asin(std::min(1.0, std::sqrt(share)));
}

/// Width and height in metres; 0 if the file does not say where it lies.
glm::dvec2 extent_m(GDALDatasetH dataset, int width, int height) {
    const Globe globe{dataset};
    const auto corner = globe.at(0, 0);
    const auto east = globe.at(width, 0);
    const auto south = globe.at(0, height);
    if (!corner || !east || !south) return {0.0, 0.0};
    return {distance_m(*corner, *east), distance_m(*corner, *south)};
}

/// The smallest 2^n + 1 that is at least `points`.
std::size_t side_for(int points) {
    return std::bit_ceil(static_cast<std::size_t>(std::max(points, 2)) - 1) + 1;
}

/// The size of the file's grid and of the square that it goes into.
struct Shape {
    int width;
    int height;
    std::size_t side;
    int wide;  ///< the part of the square without padding
    int high;
};

Shape shape_of(GDALDatasetH dataset) {
    const int width = GDALGetRasterXSize(dataset);
    const int height = GDALGetRasterYSize(dataset);
    if (width < 1 || height < 1) refuse_terrain("holds no points");
    const std::size_t side = std::max(side_for(width), side_for(height));
    check_map_size(side, side);
    const auto scaled = [&](int shorter, int longer) {
        return std::max(1, static_cast<int>(static_cast<double>(side) * shorter / longer));
    };
    return {width, height, side, scaled(width, std::max(width, height)),
            scaled(height, std::max(width, height))};
}

/// Sets the points outside the file, and those without a value in it, to its lowest elevation.
void fill_and_measure(GDALRasterBandH band, HeightGrid& grid) {
    int is_given = 0;
    const auto unknown = static_cast<float>(GDALGetRasterNoDataValue(band, &is_given));
    const auto is_known = [&](float value) {
        return std::isfinite(value) && (is_given != 0 ? value != unknown : value > -9999.0F);
    };
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const float value : grid.values) {
        if (!is_known(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) refuse_terrain("has no valid elevation");
    std::ranges::replace_if(grid.values, std::not_fn(is_known), low);
    grid.low = low;
    grid.high = high;
}

HeightGrid read(const std::filesystem::path& file) {
    const Dataset dataset = open(file);
    const Shape shape = shape_of(dataset.get());
    HeightGrid grid{.width = shape.side, .height = shape.side};
    grid.top_upside_down_m = 0.0;
    grid.values.assign(shape.side * shape.side, std::numeric_limits<float>::quiet_NaN());
    auto* band = GDALGetRasterBand(dataset.get(), 1);
    const auto row_bytes = static_cast<GSpacing>(shape.side * sizeof(float));
    if (GDALRasterIOEx(band, GF_Read, 0, 0, shape.width, shape.height, grid.values.data(),
                       shape.wide, shape.high, GDT_Float32, sizeof(float), row_bytes,
                       nullptr) != CE_None) {
        refuse_terrain("cannot be read");
    }
    fill_and_measure(band, grid);
    const glm::dvec2 wide_m = extent_m(dataset.get(), shape.width, shape.height);
    grid.size_m = {wide_m.x, wide_m.y, grid.high - grid.low};
    if (static_cast<std::size_t>(std::min(shape.width, shape.height)) != shape.side) {
        const auto points = [](auto wide, auto high) {
            return std::to_string(wide) + " x " + std::to_string(high);
        };
        grid.remarks.push_back(
            "has " + points(shape.width, shape.height) + " points, which Gazebo spreads over " +
            points(shape.wide, shape.high) + " of a square of " + points(shape.side, shape.side) +
            " and leaves the rest at the lowest elevation; scipd does the same");
    }
    return grid;
}

}  // namespace

extern "C" void scipd_read_dem(const std::filesystem::path& file, HeightGrid& grid) {
    grid = read(file);
}

}  // namespace scipd::sim
