// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/tcp_stream.h"

#include <utility>

namespace scipd::sim {

std::vector<TcpStream::Piece> TcpStream::add(std::uint32_t sequence, HostTime time,
                                             std::string_view payload) {
    std::vector<Piece> pieces;
    if (payload.empty()) return pieces;
    if (!next_) next_ = sequence;
    // Numbers wrap: the nearer way round is the one that is meant.
    const auto ahead = static_cast<std::int32_t>(sequence - *next_);
    if (ahead < 0) {
        const auto known = static_cast<std::uint64_t>(-std::int64_t{ahead});
        if (known >= payload.size()) return pieces;
        payload.remove_prefix(known);
    }
    const std::uint64_t at = position_ + static_cast<std::uint64_t>(ahead < 0 ? 0 : ahead);
    const auto [place, is_new] = waiting_.try_emplace(at);
    // Sent again with more behind it: the longer one counts.
    if (!is_new && place->second.bytes.size() >= payload.size()) return pieces;
    waiting_bytes_ += payload.size() - place->second.bytes.size();
    place->second = {time, std::string(payload)};
    take_ready(pieces);
    while (waiting_bytes_ > most_waiting) {
        skip_gap();
        take_ready(pieces);
    }
    return pieces;
}

std::vector<TcpStream::Piece> TcpStream::finish() {
    std::vector<Piece> pieces;
    while (!waiting_.empty()) {
        skip_gap();
        take_ready(pieces);
    }
    return pieces;
}

void TcpStream::take_ready(std::vector<Piece>& pieces) {
    while (!waiting_.empty() && waiting_.begin()->first <= position_) {
        auto node = waiting_.extract(waiting_.begin());
        Piece piece = std::move(node.mapped());
        waiting_bytes_ -= piece.bytes.size();
        const std::uint64_t known = position_ - node.key();
        if (known >= piece.bytes.size()) continue;
        piece.bytes.erase(0, known);
        position_ += piece.bytes.size();
        next_ = *next_ + static_cast<std::uint32_t>(piece.bytes.size());
        pieces.push_back(std::move(piece));
    }
}

void TcpStream::skip_gap() {
    const std::uint64_t gap = waiting_.begin()->first - position_;
    lost_ += gap;
    position_ += gap;
    next_ = *next_ + static_cast<std::uint32_t>(gap);
}

}  // namespace scipd::sim
