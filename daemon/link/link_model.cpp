// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/link_model.h"

#include <algorithm>
#include <utility>

namespace scipd::daemon {
namespace {

constexpr std::int64_t bits_per_byte = 10;  // 8N1: with the start and the stop bit

// What a line brings within this time comes as one piece, so that a fast one does not wake its
// reader 75 000 times a second. The buffers of real serial ports do the same, for longer.
constexpr sim::Time line_grain = std::chrono::milliseconds(1);

}  // namespace

LinkModel::LinkModel(const LinkConfig& config, const sim::ChanceKey& chance)
    : config_(config), chance_(chance) {}

void LinkModel::send(std::string message, sim::Time now) {
    bytes_ += message.size();
    if (group_ && group_->leaves <= now) end_group();
    if (group_) {
        group_->bytes += message;
    } else if (config_.coalesce > sim::Time::zero()) {
        group_ = Group{now + config_.coalesce, std::move(message)};
    } else {
        leave(std::move(message), now);
    }
}

void LinkModel::set_rate(int bits_per_second) {
    if (bits_per_second == rate_) return;
    if (group_) end_group();
    rate_ = bits_per_second;
    pieces_.push_back({.at = last_there_, .bytes = {}, .bits_per_second = rate_});
}

void LinkModel::set_config(const LinkConfig& config, sim::Time now) {
    if (config == config_) return;
    if (group_) end_group();
    const bool faster = config.latency + config.jitter < config_.latency + config_.jitter;
    config_ = config;
    // On a serial line it is the rate that takes the time.
    if (!faster || rate_ != 0) return;
    line_free_ = std::min(line_free_, now);
    last_there_ = std::min(last_there_, now + config.latency + config.jitter);
    for (Piece& piece : pieces_)
        piece.at = std::min(piece.at, last_there_);
}

std::optional<sim::Time> LinkModel::next_at() const {
    if (!pieces_.empty()) return pieces_.front().at;
    return group_ ? std::optional(group_->leaves) : std::nullopt;
}

std::optional<LinkModel::Piece> LinkModel::take(sim::Time now) {
    if (group_ && group_->leaves <= now) end_group();
    if (pieces_.empty() || pieces_.front().at > now) return std::nullopt;
    Piece piece = std::move(pieces_.front());
    pieces_.pop_front();
    bytes_ -= piece.bytes.size();
    return piece;
}

void LinkModel::clear() {
    group_.reset();
    pieces_.clear();
    bytes_ = 0;
    line_free_ = last_there_ = sim::Time::min();
}

void LinkModel::leave(std::string message, sim::Time at) {
    const sim::Time delay = next_delay();
    const auto add = [&](std::string bytes) {
        line_free_ = std::max(line_free_, at) + time_of(bytes.size());
        last_there_ = std::max(last_there_, line_free_ + delay);
        pieces_.push_back({last_there_, std::move(bytes), rate_});
    };
    const std::size_t size = message.size();
    const std::size_t grain = grain_bytes();
    if (size <= grain && part_end(0, size) == size) return add(std::move(message));
    for (std::size_t begin = 0; begin < size;) {
        if (begin > 0) line_free_ += config_.split_pause;
        for (const std::size_t end = part_end(begin, size); begin < end;) {
            const std::size_t count = std::min(grain, end - begin);
            add(message.substr(begin, count));
            begin += count;
        }
    }
}

void LinkModel::end_group() {
    Group group = std::move(*std::exchange(group_, std::nullopt));
    leave(std::move(group.bytes), group.leaves);
}

std::size_t LinkModel::part_end(std::size_t begin, std::size_t size) const {
    std::size_t end = size;
    if (config_.split_bytes > 0)
        end = std::min(end, begin + static_cast<std::size_t>(config_.split_bytes));
    for (const int offset : config_.split_at) {
        const auto at = static_cast<std::size_t>(offset);
        if (at > begin) end = std::min(end, at);
    }
    return end;
}

std::size_t LinkModel::grain_bytes() const {
    if (rate_ == 0) return std::string::npos;
    return static_cast<std::size_t>(std::max<std::int64_t>(line_grain / time_of(1), 1));
}

sim::Time LinkModel::time_of(std::size_t bytes) const {
    if (rate_ == 0) return sim::Time::zero();
    constexpr sim::Time second = std::chrono::seconds(1);
    return second * bits_per_byte * static_cast<std::int64_t>(bytes) / rate_;
}

sim::Time LinkModel::next_delay() {
    if (config_.jitter == sim::Time::zero()) return config_.latency;
    const double share = sim::Chance(chance_).even(0);
    ++chance_.scan;
    const sim::Time jitter(
        static_cast<std::int64_t>(share * static_cast<double>(config_.jitter.count())));
    return std::max(config_.latency + jitter, sim::Time::zero());
}

}  // namespace scipd::daemon
