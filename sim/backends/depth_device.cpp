// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/backends/depth_probe.h"
#include "sim/backends/depth_raster.h"

namespace scipd::sim {
namespace {

/// Two quads before the eye, one before the other, seen twice: drawn from near to far and from far
/// to near. Their numbers need all 32 bits.
class TestPicture {
  public:
    void add_quad(double half, double ahead_m, double slant) {
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (const glm::dvec2& corner :
             {glm::dvec2{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
            const double z_m = ahead_m / (1.0 - slant * corner.x);
            const glm::vec3 point_m{z_m, corner.x * z_m, corner.y * z_m};
            vertices_.push_back({eye_m + point_m, number(vertices_.size())});
        }
        triangles_.push_back({{first, first + 1, first + 2}});
        triangles_.push_back({{first + 3, first, first + 2}});
    }

    /// The number that the quad's lower right, or upper left, triangle is drawn with.
    static std::uint32_t number(std::size_t vertex) {
        return 0xA5000000U + static_cast<std::uint32_t>(vertex) * 0x10001U;
    }

    void draw(DepthRaster& raster, Picture& picture) const {
        std::vector<DrawnTriangle> both = triangles_;
        both.insert(both.end(), triangles_.rbegin(), triangles_.rend());
        raster.set_vertices(vertices_);
        DrawnView one_way{.size_px = strip.size_px,
                          .eye_m = eye_m,
                          .clip_from_eye = glm::mat4{clip_from_sensor(strip)},
                          .triangle_count = triangles_.size()};
        DrawnView other_way = one_way;
        other_way.corner_px = {side_px, 0};
        other_way.first_triangle = triangles_.size();
        const std::array<DrawnView, 2> views{one_way, other_way};
        raster.draw(views, both, {2 * side_px, side_px});
        raster.read(picture);
    }

    static constexpr int side_px = 32;
    inline static const glm::vec3 eye_m{100, -200, 30};
    inline static const Strip strip{.first = {-31.0 / 32.0, -31.0 / 32.0},
                                    .pitch = {1.0 / 16.0, 1.0 / 16.0},
                                    .size_px = {side_px, side_px}};

  private:
    std::vector<DrawnVertex> vertices_;
    std::vector<DrawnTriangle> triangles_;
};

/// What a pixel of the test picture must show.
struct Expected {
    bool anything = false;
    std::size_t quad = 0;
    double z_m = 0.0;
};

Expected expected_at(double a, double b) {
    const double off = std::max(std::abs(a), std::abs(b));
    if (off < 0.5) return {true, 1, 2.0};
    if (off < 0.75) return {true, 0, 5.0 / (1.0 - 0.5 * a)};
    return {};
}

bool right(const Expected& expected, float depth, std::uint32_t shown, double a, double b) {
    if (!expected.anything) return shown == Picture::nothing && depth == 0.0F;
    // The diagonal goes through pixel centres, which may belong to either triangle.
    const std::uint32_t lower = TestPicture::number(4 * expected.quad);
    const std::uint32_t upper = TestPicture::number(4 * expected.quad + 3);
    const bool number_right = a > b   ? shown == lower
                              : a < b ? shown == upper
                                      : shown == lower || shown == upper;
    constexpr double depth_tolerance = 1e-5;  // relative; rounding is about 1e-7
    return number_right && std::abs(double{depth} * expected.z_m / near_m - 1.0) < depth_tolerance;
}

std::string refusals(const std::vector<std::string>& reasons) {
    std::string text = "no depth buffer can be drawn on this machine";
    for (const std::string& reason : reasons)
        text += "; " + reason;
    return text;
}

std::shared_ptr<EglContext> open(const EglPlace& place) {
    auto context = std::make_shared<EglContext>(place);
    if (const auto failure = failure_of_self_test(context))
        throw std::runtime_error("EGL " + place.name + ": " + *failure);
    return context;
}

/// Surfaceless is where Mesa is, which on a machine with another maker's device draws with the
/// processor; then that device, which a driver of its own serves, is better.
std::shared_ptr<EglContext> open_best() {
    std::vector<std::string> reasons;
    std::shared_ptr<EglContext> software;
    for (const EglPlace& place : egl_places()) {
        if (software && place.software) continue;
        try {
            auto context = open(place);
            if (!context->description().software()) return context;
            if (!software) software = std::move(context);
        } catch (const std::runtime_error& error) {
            reasons.emplace_back(error.what());
        }
    }
    if (!software) throw std::runtime_error(refusals(reasons));
    software->bind();
    return software;
}

std::string describe(const EglPlace& place) {
    std::string text = place.name + (place.software ? " (the processor)" : "") + "\n";
    try {
        const auto context = std::make_shared<EglContext>(place);
        const EglDescription& it = context->description();
        text += "  EGL         " + it.egl + "\n";
        text += "  renderer    " + it.renderer + "\n";
        text += "  OpenGL      " + it.opengl + "\n";
        text += "  limits      pictures of " + std::to_string(it.largest_picture_px) + " pixels, " +
                std::to_string(it.viewports) + " viewports, " + std::to_string(it.sub_pixel_bits) +
                " sub-pixel bits\n";
        const auto failure = failure_of_self_test(context);
        text += "  self-test   " + failure.value_or("passed") + "\n";
    } catch (const std::runtime_error& error) {
        text += "  unusable    " + std::string(error.what()) + "\n";
    }
    return text;
}

}  // namespace

std::optional<std::string> failure_of_self_test(const std::shared_ptr<EglContext>& context) {
    DepthRaster raster(context);
    TestPicture test;
    test.add_quad(0.75, 5.0, 0.5);
    test.add_quad(0.5, 2.0, 0.0);
    Picture picture;
    test.draw(raster, picture);
    const Strip& strip = TestPicture::strip;
    int wrong = 0;
    for (int y = 0; y < picture.size_px.y; ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            const glm::dvec2 pixel{x % TestPicture::side_px, y};
            const glm::dvec2 at = strip.first + pixel * strip.pitch;
            const auto i = static_cast<std::size_t>(y * picture.size_px.x + x);
            if (!right(expected_at(at.x, at.y), picture.depth[i], picture.triangle[i], at.x, at.y))
                ++wrong;
        }
    }
    if (wrong == 0) return std::nullopt;
    return "the self-test picture comes out wrong in " + std::to_string(wrong) + " of " +
           std::to_string(picture.depth.size()) + " pixels";
}

std::shared_ptr<EglContext> depth_context() {
    thread_local std::weak_ptr<EglContext> shared;
    std::shared_ptr<EglContext> context = shared.lock();
    if (!context || !context->bound()) shared = context = open_best();
    return context;
}

BackendProbe probe_depth() {
    BackendProbe probe;
    try {
        for (const EglPlace& place : egl_places())
            probe.text += describe(place);
        probe.text += "used: " + depth_context()->place().name + "\n";
        probe.usable = true;
    } catch (const std::runtime_error& error) {
        probe.text += std::string(error.what()) + "\n";
    }
    return probe;
}

}  // namespace scipd::sim
