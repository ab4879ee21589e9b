// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cuts from the holes to the outline make one loop of all of them. Ears are then clipped from it.
#include "sim/loaders/mesh/polygon_with_holes.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace scipd::sim {
namespace {

/// Twice the area of the triangle; above 0 if a, b, c turn left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether the segments ab and cd meet. To touch counts, to share an end does not.
bool meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    if (a == c || a == d || b == c || b == d) return false;
    const auto between = [](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
        return glm::min(p, q) == glm::min(glm::min(p, q), r) &&
               glm::max(p, q) == glm::max(glm::max(p, q), r);
    };
    const double c_side = turn(a, b, c);
    const double d_side = turn(a, b, d);
    const double a_side = turn(c, d, a);
    const double b_side = turn(c, d, b);
    if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
    return (c_side == 0.0 && between(a, b, c)) || (d_side == 0.0 && between(a, b, d)) ||
           (a_side == 0.0 && between(c, d, a)) || (b_side == 0.0 && between(c, d, b));
}

/// Works in the two coordinates in which the polygon is largest. There the outline turns left.
class Clipper {
  public:
    Clipper(const Loop& outline, const std::vector<glm::dvec3>& points) : points_(points) {
        glm::dvec3 normal{0.0};
        for (std::size_t i = 0; i < outline.size(); ++i) {
            normal += glm::cross(points[outline[i]] - points[outline[0]],
                                 points[outline[(i + 1) % outline.size()]] - points[outline[0]]);
        }
        const glm::dvec3 size = glm::abs(normal);
        const int up = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        across_ = (up + 1) % 3;
        along_ = (up + 2) % 3;
    }

    void run(Loop outline, std::vector<Loop> holes) {
        if (area(outline) < 0.0) std::ranges::reverse(outline);
        for (Loop& hole : holes) {
            if (area(hole) > 0.0) std::ranges::reverse(hole);
            const auto rightmost = std::ranges::max_element(
                hole, {}, [&](std::size_t corner) { return at(corner).x; });
            std::rotate(hole.begin(), rightmost, hole.end());
        }
        std::ranges::sort(holes, std::ranges::greater{},
                          [&](const Loop& hole) { return at(hole[0]).x; });
        loop_ = std::move(outline);
        for (std::size_t i = 0; i < holes.size(); ++i)
            cut_to(holes[i], {holes.begin() + static_cast<std::ptrdiff_t>(i), holes.end()});
        clip();
    }

    [[nodiscard]] std::vector<std::array<std::size_t, 3>>& triangles() { return triangles_; }

  private:
    [[nodiscard]] glm::dvec2 at(std::size_t point) const {
        return {points_[point][across_], points_[point][along_]};
    }
    [[nodiscard]] glm::dvec2 corner(std::size_t i) const { return at(loop_[i % loop_.size()]); }

    [[nodiscard]] double area(const Loop& loop) const {
        double area = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i)
            area += turn(at(loop[0]), at(loop[i]), at(loop[(i + 1) % loop.size()]));
        return area;
    }

    [[nodiscard]] bool crosses(const glm::dvec2& from, const glm::dvec2& to,
                               const Loop& loop) const {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (meet(from, to, at(loop[i]), at(loop[(i + 1) % loop.size()]))) return true;
        }
        return false;
    }

    /// Whether the line from this corner to `there` begins inside the loop. A point may be several
    /// corners of the loop, since cuts come back to it.
    [[nodiscard]] bool opens_to(std::size_t i, const glm::dvec2& there) const {
        const glm::dvec2 before = corner(i + loop_.size() - 1);
        const bool after_last = turn(corner(i), corner(i + 1), there) >= 0.0;
        const bool before_first = turn(before, corner(i), there) >= 0.0;
        return turn(before, corner(i), corner(i + 1)) >= 0.0 ? after_last && before_first
                                                             : after_last || before_first;
    }

    /// Cuts from the hole's first corner to the nearest corner of the loop that is in sight.
    void cut_to(const Loop& hole, const std::vector<Loop>& in_the_way) {
        const glm::dvec2 from = at(hole[0]);
        std::size_t best = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < loop_.size(); ++i) {
            const double distance = glm::distance(from, corner(i));
            if (distance >= nearest || !opens_to(i, from) || crosses(from, corner(i), loop_) ||
                std::ranges::any_of(in_the_way, [&](const Loop& other) {
                    return crosses(from, corner(i), other);
                })) {
                continue;
            }
            nearest = distance;
            best = i;
        }
        Loop way = hole;
        way.push_back(hole[0]);
        way.push_back(loop_[best]);
        loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(best) + 1, way.begin(), way.end());
    }

    [[nodiscard]] bool is_ear(std::size_t i) const {
        const std::array ends{corner(i + loop_.size() - 1), corner(i), corner(i + 1)};
        if (turn(ends[0], ends[1], ends[2]) <= 0.0) return false;
        return std::ranges::none_of(loop_, [&](std::size_t other) {
            const glm::dvec2 p = at(other);
            return std::ranges::find(ends, p) == ends.end() && turn(ends[0], ends[1], p) >= 0.0 &&
                   turn(ends[1], ends[2], p) >= 0.0 && turn(ends[2], ends[0], p) >= 0.0;
        });
    }

    /// Whether this corner and its neighbours lie on one line.
    [[nodiscard]] bool is_flat(std::size_t i) const {
        return turn(corner(i + loop_.size() - 1), corner(i), corner(i + 1)) == 0.0;
    }

    void clip() {
        while (loop_.size() >= 3) {
            std::size_t ear = 0;
            while (ear < loop_.size() && !is_ear(ear))
                ++ear;
            for (std::size_t i = 0; ear == loop_.size() && i < loop_.size(); ++i) {
                if (is_flat(i)) ear = i;
            }
            ear %= loop_.size();
            if (!is_flat(ear)) {
                triangles_.push_back({loop_[(ear + loop_.size() - 1) % loop_.size()], loop_[ear],
                                      loop_[(ear + 1) % loop_.size()]});
            }
            loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
    }

    const std::vector<glm::dvec3>& points_;
    int across_;
    int along_;
    Loop loop_;
    std::vector<std::array<std::size_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangles_of(Loop outline, std::vector<Loop> holes,
                                                     const std::vector<glm::dvec3>& points) {
    if (outline.size() < 3) return {};
    std::erase_if(holes, [](const Loop& hole) { return hole.size() < 3; });
    Clipper clipper{outline, points};
    clipper.run(std::move(outline), std::move(holes));
    return std::move(clipper.triangles());
}

}  // namespace scipd::sim
