// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/point_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <map>

namespace scipd::tools {
namespace {

/// Paul Tol's "muted": nine colours that all people can tell apart, on white paper as well.
constexpr std::array<Colour, 9> of_materials{{{0.200, 0.133, 0.533},
                                              {0.533, 0.800, 0.933},
                                              {0.067, 0.467, 0.200},
                                              {0.800, 0.400, 0.467},
                                              {0.867, 0.800, 0.467},
                                              {0.533, 0.133, 0.333},
                                              {0.267, 0.667, 0.600},
                                              {0.667, 0.267, 0.600},
                                              {0.600, 0.600, 0.200}}};
constexpr Colour unknown{0.60, 0.60, 0.60};
constexpr int stops = 20;

/// From blue (too near) over grey to red (too far).
Colour too_near_or_far(double share) {
    constexpr Colour near{0.129, 0.400, 0.675};
    constexpr Colour right{0.80, 0.80, 0.80};
    constexpr Colour far{0.698, 0.094, 0.169};
    const double place = 2.0 * std::clamp(share, 0.0, 1.0) - 1.0;
    const Colour& end = place < 0.0 ? near : far;
    const double part = std::abs(place);
    return {right.red + part * (end.red - right.red),
            right.green + part * (end.green - right.green),
            right.blue + part * (end.blue - right.blue)};
}

using Value = std::function<std::optional<double>(const ViewPoint&)>;

/// What the points have, by size.
std::vector<double> sorted(const TopView& view, const Value& value) {
    std::vector<double> values;
    for (const auto* const points : {&view.points, &view.further}) {
        for (const ViewPoint& point : *points) {
            if (const auto has = value(point)) values.push_back(*has);
        }
    }
    std::ranges::sort(values);
    return values;
}

/// Leaves out the few smallest and largest values: otherwise one reflector would leave a single
/// colour for everything else.
struct Span {
    double least = 0.0;
    double most = 0.0;

    [[nodiscard]] double share(double value) const {
        return most > least ? (value - least) / (most - least) : 1.0;
    }
};

Span span_of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const std::size_t left_out = values.size() / 20;
    return {values[left_out], values[values.size() - 1 - left_out]};
}

using Palette = Colour (*)(double share);

Colouring on_a_scale(const TopView& view, const Value& value, const Span& span, Palette palette) {
    const auto styles = [&](const std::vector<ViewPoint>& points) {
        std::vector<PointStyle> all;
        for (const ViewPoint& point : points) {
            const auto has = value(point);
            all.push_back({has ? palette(span.share(*has)) : unknown});
        }
        return all;
    };
    Colouring colouring{styles(view.points), styles(view.further), {}};
    for (int i = 0; i <= stops; ++i)
        colouring.legend.scale.push_back(palette(static_cast<double>(i) / stops));
    return colouring;
}

std::string with_digits(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

Colouring by_distance(const TopView& view) {
    const Value range_m = [](const ViewPoint& point) { return std::optional(point.range_m); };
    const Span span = span_of(sorted(view, range_m));
    Colouring colouring = on_a_scale(view, range_m, span, viridis);
    colouring.legend.title = "distance, m";
    colouring.legend.least = with_digits(span.least, 2);
    colouring.legend.most = with_digits(span.most, 2);
    return colouring;
}

/// The scale is logarithmic, because returns fade with the square of their distance.
Colouring by_intensity(const TopView& view) {
    const Value logarithm = [](const ViewPoint& point) {
        return std::optional(std::log(std::max(1.0, static_cast<double>(point.intensity))));
    };
    const Span span = span_of(sorted(view, logarithm));
    Colouring colouring = on_a_scale(view, logarithm, span, viridis);
    colouring.legend.title = "intensity, logarithmic";
    colouring.legend.least = with_digits(std::exp(span.least), 0);
    colouring.legend.most = with_digits(std::exp(span.most), 0);
    return colouring;
}

/// The scale ends at about three times the usual error: where a sensor sees an edge, it is wrong by
/// metres.
Colouring by_error(const TopView& view) {
    const Value error_m = [](const ViewPoint& point) { return point.error_m; };
    const auto sizes = sorted(view, [](const ViewPoint& point) {
        return point.error_m ? std::optional(std::abs(*point.error_m)) : std::nullopt;
    });
    constexpr double least_m = 0.001;
    const double usual_m = sizes.empty() ? 0.0 : sizes[sizes.size() / 2];
    const double most_m = round_step_m(std::max(least_m, 3.0 * usual_m), 1.0);
    Colouring colouring = on_a_scale(view, error_m, {-most_m, most_m}, too_near_or_far);
    const std::string limit = with_digits(most_m * 1000.0, 0);
    colouring.legend.title = "sent - true, mm";
    colouring.legend.least = "-" + limit;
    colouring.legend.most = "+" + limit;
    return colouring;
}

PointStyle style_of(std::size_t material) {
    constexpr std::size_t shapes = 3;
    return {of_materials[material % of_materials.size()],
            static_cast<Shape>(material / of_materials.size() % shapes)};
}

/// How many points have each material.
std::map<std::string, int> counted(const TopView& view) {
    std::map<std::string, int> points_of;
    for (const auto* const points : {&view.points, &view.further}) {
        for (const ViewPoint& point : *points)
            ++points_of[point.material];
    }
    return points_of;
}

/// Those of the world in its order, so that a material has one colour in all scans and on the live
/// page; then others of the points, those of the most points first; then none.
std::vector<std::string> in_order(const TopView& view,
                                  const std::map<std::string, int>& points_of) {
    std::vector<std::string> others;
    for (const auto& [name, points] : points_of)
        others.push_back(name);
    std::ranges::stable_sort(others, std::ranges::greater{}, [&](const std::string& name) {
        return name.empty() ? 0 : points_of.at(name);
    });
    std::vector<std::string> names = view.materials;
    names.insert(names.end(), others.begin(), others.end());
    return names;
}

Colouring by_material(const TopView& view) {
    Colouring colouring{.points = {}, .further = {}, .legend = {.title = "material"}};
    const std::map<std::string, int> points_of = counted(view);
    std::map<std::string, PointStyle> styles;
    for (const std::string& name : in_order(view, points_of)) {
        const auto [entry, is_new] =
            styles.try_emplace(name, name.empty() ? PointStyle{unknown} : style_of(styles.size()));
        if (is_new && points_of.contains(name))
            colouring.legend.names.push_back({name.empty() ? "none" : name, entry->second});
    }
    for (const ViewPoint& point : view.points)
        colouring.points.push_back(styles[point.material]);
    for (const ViewPoint& point : view.further)
        colouring.further.push_back(styles[point.material]);
    return colouring;
}

}  // namespace

Colouring colour_points(const TopView& view, std::optional<ColourBy> by) {
    if (by == ColourBy::distance) return by_distance(view);
    if (by == ColourBy::intensity) return by_intensity(view);
    if (by == ColourBy::material) return by_material(view);
    if (by == ColourBy::error) return by_error(view);
    return {std::vector<PointStyle>(view.points.size()),
            std::vector<PointStyle>(view.further.size()),
            {}};
}

}  // namespace scipd::tools
