// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/tape.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

namespace scipd::daemon {
namespace {

std::runtime_error cannot_keep() {
    return std::runtime_error("cannot be kept in a temporary file: " +
                              std::generic_category().message(errno));
}

template <class Value>
void put(const std::vector<Value>& values, std::FILE* file) {
    if (std::fwrite(values.data(), sizeof(Value), values.size(), file) != values.size())
        throw cannot_keep();
}

/// From this place in the file, which grows by what was read.
template <class Value>
void take(std::vector<Value>& values, std::size_t count, int file, off_t& at) {
    values.resize(count);
    const std::size_t bytes = count * sizeof(Value);
    if (::pread(file, values.data(), bytes, at) != static_cast<ssize_t>(bytes))
        std::ranges::fill(values, Value{});
    at += static_cast<off_t>(bytes);
}

}  // namespace

Tape::Tape(std::size_t steps, bool has_echoes)
    : steps_(steps), has_echoes_(has_echoes), file_(std::tmpfile()) {
    if (!file_) throw cannot_keep();
}

void Tape::add(const TapedScan& scan, std::uint32_t stamp_ms, sim::Time begin) {
    assert(scan.distance.size() == steps_ && scan.intensity.size() == steps_);
    put(scan.distance, file_.get());
    put(scan.intensity, file_.get());
    if (has_echoes_) put(scan.echoes, file_.get());
    stamps_ms_.push_back(stamp_ms);
    begins_.push_back(begin);
}

void Tape::end(sim::Time last) {
    if (std::fflush(file_.get()) != 0) throw cannot_keep();
    begins_.push_back(begins_.empty() ? last : begins_.back() + last);
}

std::size_t Tape::bytes_of_scan() const {
    return steps_ * (2 * sizeof(std::uint32_t) + (has_echoes_ ? sizeof(protocol::StepEchoes) : 0));
}

void Tape::cut(sim::Time from, sim::Time to) {
    for (sim::Time& begin : begins_)
        if (begin >= to) begin -= to - from;
}

TapedScan Tape::scan(std::size_t index) const {
    TapedScan scan;
    auto at = static_cast<off_t>(index * bytes_of_scan());
    const int file = ::fileno(file_.get());
    take(scan.distance, steps_, file, at);
    take(scan.intensity, steps_, file, at);
    if (has_echoes_) take(scan.echoes, steps_, file, at);
    return scan;
}

std::size_t Tape::at(sim::Time since_first) const {
    const auto later = std::ranges::upper_bound(begins_.begin(), begins_.end() - 1, since_first);
    const auto before = std::max<std::ptrdiff_t>(later - begins_.begin() - 1, 0);
    return static_cast<std::size_t>(before);
}

std::size_t Tape::next(sim::Time since_first) const {
    const auto next = std::ranges::lower_bound(begins_.begin(), begins_.end() - 1, since_first);
    return static_cast<std::size_t>(next - begins_.begin());
}

}  // namespace scipd::daemon
