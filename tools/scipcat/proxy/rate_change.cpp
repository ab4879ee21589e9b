// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/rate_change.h"

#include <charconv>
#include <cstddef>

namespace scipd::tools {
namespace {

/// SS019200 and whatever follows, S0192000000000; 0: no such request.
int rate_in(std::string_view request) {
    constexpr std::size_t rate_digits = 6;
    constexpr std::size_t scip1_length = 14;
    const bool scip2 = request.starts_with("SS");
    if (!scip2 && !(request.starts_with("S") && request.size() == scip1_length)) return 0;
    const std::string_view digits = request.substr(scip2 ? 2 : 1, rate_digits);
    int rate = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rate);
    return digits.size() == rate_digits && stop == digits.data() + rate_digits ? rate : 0;
}

/// 00 and its sum, or 0 of SCIP 1.1. What a scanner refuses, or has already, changes nothing.
bool agrees(std::string_view status) {
    return status == "0" || (status.size() == 3 && status.starts_with("00"));
}

}  // namespace

void RateChange::asks(std::string_view bytes) {
    while (const auto line = reader_.next(bytes)) {
        if (const int rate = rate_in(line->text); rate > 0) {
            request_ = line->text;
            rate_ = rate;
        }
    }
}

std::optional<int> RateChange::answers(std::string_view bytes) {
    std::optional<int> rate;
    for (const char c : bytes) {
        if (c != '\n') {
            if (!request_.empty() && line_.size() <= protocol::LineReader::max_length) line_ += c;
            continue;
        }
        if (const auto agreed = take(line_)) rate = agreed;
        line_.clear();
    }
    return rate;
}

std::optional<int> RateChange::take(const std::string& line) {
    if (request_.empty()) return std::nullopt;
    switch (next_) {
        case Next::echo:
            if (line == request_) next_ = Next::status;
            return std::nullopt;
        case Next::status:
            next_ = agrees(line) ? Next::end : Next::echo;
            if (next_ == Next::echo) request_.clear();
            return std::nullopt;
        case Next::end:
            break;
    }
    next_ = Next::echo;
    request_.clear();
    return rate_;
}

}  // namespace scipd::tools
