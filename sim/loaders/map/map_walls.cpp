// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_walls.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace scipd::sim {
namespace {

/// Corners that follow each other along one line of the grid. A corner is two vertices: `first`
/// below, first + 1 above; the next corner is first + 2.
struct Chain {
    glm::uint first = 0;
    glm::uint count = 0;

    [[nodiscard]] glm::uint last() const { return first + 2 * (count - 1); }
};

/// A run of neighbouring cells in one row, and in all rows above it that have the same run.
struct Block {
    std::size_t begin;  ///< columns
    std::size_t end;
    Chain bottom;  ///< along its lower side

    [[nodiscard]] bool same_columns(const Block& other) const {
        return begin == other.begin && end == other.end;
    }
};

/// Sweeps over the lines of the grid from below. On each, blocks end and others begin.
class WallBuilder {
  public:
    WallBuilder(const CellGrid& grid, Cell which, const WallSize& size)
        : grid_(grid), which_(which), size_(size) {}

    Mesh run() && {
        for (std::size_t line = 0; line <= grid_.rows; ++line) {
            sort_blocks(line < grid_.rows ? runs_of(line) : std::vector<Block>{});
            set_corners(line);
            end_blocks();
            begin_blocks();
            raise_walls_along_line();
            if (mesh_.triangles.size() > size_.most_triangles) {
                throw std::invalid_argument("has walls of more than " +
                                            std::to_string(size_.most_triangles) +
                                            " triangles; is it noise?");
            }
        }
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] std::vector<Block> runs_of(std::size_t row) const;
    void sort_blocks(std::vector<Block> runs);
    void set_corners(std::size_t line);
    void end_blocks();
    void begin_blocks();
    void raise_walls_along_line();
    Chain chain_of(const Block& block);
    void add_cap(const Chain& bottom, const Chain& top);
    void add_wall(glm::uint from, glm::uint to);
    void add_triangle(glm::uint a, glm::uint b, glm::uint c) {
        mesh_.triangles.emplace_back(a, b, c);
    }

    const CellGrid& grid_;
    Cell which_;
    WallSize size_;
    Mesh mesh_;
    std::vector<Block> open_;  ///< after sort_blocks(): those of the row above the line
    std::vector<Block> ending_;
    std::vector<Block> beginning_;
    std::vector<std::size_t> corners_;  ///< the columns of corners on this line
    glm::uint first_corner_ = 0;
    /// For each corner: whether only one side of the line from it to the next has cells.
    std::vector<bool> is_edge_;
};

std::vector<Block> WallBuilder::runs_of(std::size_t row) const {
    std::vector<Block> runs;
    const auto begin = grid_.cells.begin() + static_cast<std::ptrdiff_t>(row * grid_.columns);
    const auto end = begin + static_cast<std::ptrdiff_t>(grid_.columns);
    for (auto at = std::find(begin, end, which_); at != end; at = std::find(at, end, which_)) {
        const auto stop = std::find_if(at, end, [this](Cell cell) { return cell != which_; });
        runs.push_back(
            {static_cast<std::size_t>(at - begin), static_cast<std::size_t>(stop - begin), {}});
        at = stop;
    }
    return runs;
}

/// Sorts out which blocks go on, end and begin at a line: the open ones lie below it, these runs
/// above it.
void WallBuilder::sort_blocks(std::vector<Block> runs) {
    ending_.clear();
    beginning_.clear();
    auto old = open_.begin();
    for (Block& run : runs) {
        while (old != open_.end() && old->begin < run.begin)
            ending_.push_back(*old++);
        if (old != open_.end() && old->same_columns(run)) {
            run = *old++;
        } else {
            beginning_.push_back(run);
        }
    }
    ending_.insert(ending_.end(), old, open_.end());
    open_ = std::move(runs);
}

void WallBuilder::set_corners(std::size_t line) {
    corners_.clear();
    for (const auto* blocks : {&ending_, &beginning_}) {
        for (const Block& block : *blocks)
            corners_.insert(corners_.end(), {block.begin, block.end});
    }
    std::ranges::sort(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());

    first_corner_ = static_cast<glm::uint>(mesh_.vertices_m.size());
    const auto from_middle_m = [this](std::size_t index, std::size_t count) {
        return (static_cast<double>(index) - 0.5 * static_cast<double>(count)) * size_.cell_m;
    };
    const double y_m = from_middle_m(line, grid_.rows);
    for (const std::size_t column : corners_) {
        const double x_m = from_middle_m(column, grid_.columns);
        mesh_.vertices_m.emplace_back(x_m, y_m, size_.bottom_m);
        mesh_.vertices_m.emplace_back(x_m, y_m, size_.top_m);
    }
    is_edge_.assign(corners_.size(), false);
}

Chain WallBuilder::chain_of(const Block& block) {
    const auto begin = std::ranges::lower_bound(corners_, block.begin);
    const auto end = std::lower_bound(begin, corners_.end(), block.end);
    const auto position = static_cast<glm::uint>(begin - corners_.begin());
    for (auto at = begin; at != end; ++at) {
        auto edge = is_edge_[static_cast<std::size_t>(at - corners_.begin())];
        edge = !edge;
    }
    return {first_corner_ + 2 * position, static_cast<glm::uint>(end - begin) + 1};
}

void WallBuilder::end_blocks() {
    for (const Block& block : ending_) {
        const Chain top = chain_of(block);
        add_cap(block.bottom, top);
        add_wall(block.bottom.first, top.first);
        add_wall(block.bottom.last(), top.last());
    }
}

void WallBuilder::begin_blocks() {
    auto begun = open_.begin();
    for (const Block& block : beginning_) {
        begun = std::find_if(begun, open_.end(),
                             [&](const Block& open) { return open.begin == block.begin; });
        begun->bottom = chain_of(block);
    }
}

void WallBuilder::raise_walls_along_line() {
    for (glm::uint i = 0; i < is_edge_.size(); ++i) {
        if (is_edge_[i]) add_wall(first_corner_ + 2 * i, first_corner_ + 2 * (i + 1));
    }
}

/// The bottom and the top of a block, with all corners of both its sides.
void WallBuilder::add_cap(const Chain& bottom, const Chain& top) {
    for (const glm::uint level : {0U, 1U}) {
        for (glm::uint i = bottom.first; i < bottom.last(); i += 2)
            add_triangle(i + level, i + 2 + level, top.first + level);
        for (glm::uint i = top.first; i < top.last(); i += 2)
            add_triangle(i + level, i + 2 + level, bottom.last() + level);
    }
}

void WallBuilder::add_wall(glm::uint from, glm::uint to) {
    add_triangle(from, to, to + 1);
    add_triangle(from, to + 1, from + 1);
}

}  // namespace

Mesh wall_mesh(const CellGrid& grid, Cell which, const WallSize& size) {
    return WallBuilder{grid, which, size}.run();
}

}  // namespace scipd::sim
