// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One quantity of all pairs of beams, summed up over each block of scans. A value; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tools/analysis/blocks.h"

namespace scipd::tools::comparing {

class BlockTable {
  public:
    BlockTable(std::span<const ScanSpan> blocks, std::size_t pairs)
        : blocks_(blocks.begin(), blocks.end()),
          pairs_(pairs),
          sums_(blocks.size() * pairs),
          counts_(blocks.size() * pairs) {}

    /// `value_of(scan, pair)` is the quantity, or NaN where there is none.
    template <class ValueOf>
    void fill(const ValueOf& value_of) {
        for (std::size_t block = 0; block < blocks_.size(); ++block) {
            for (std::size_t scan = blocks_[block].first; scan < blocks_[block].end; ++scan) {
                for (std::size_t pair = 0; pair < pairs_; ++pair)
                    add(block, pair, value_of(scan, pair));
            }
        }
    }

    [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
    [[nodiscard]] std::size_t pairs() const { return pairs_; }
    [[nodiscard]] double sum(std::size_t block, std::size_t pair) const {
        return sums_[block * pairs_ + pair];
    }
    [[nodiscard]] double count(std::size_t block, std::size_t pair) const {
        return counts_[block * pairs_ + pair];
    }

  private:
    void add(std::size_t block, std::size_t pair, double value) {
        if (!(value == value)) return;
        sums_[block * pairs_ + pair] += value;
        counts_[block * pairs_ + pair] += 1;
    }

    std::vector<ScanSpan> blocks_;
    std::size_t pairs_;
    std::vector<double> sums_;
    std::vector<double> counts_;
};

}  // namespace scipd::tools::comparing
