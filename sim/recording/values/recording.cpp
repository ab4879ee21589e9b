// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/values/recording.h"

#include <algorithm>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Warnings about damage in one file. A hostile one may hold a million damaged parts.
constexpr std::size_t most_losses_named = 20;
constexpr std::size_t most_topics_named = 20;

std::string names_of(const std::set<std::string>& things) {
    std::string names;
    std::size_t count = 0;
    for (const std::string& thing : things) {
        if (count++ == most_topics_named)
            return names + " and " + std::to_string(things.size() - most_topics_named) + " more";
        names += (names.empty() ? "" : ", ") + thing;
    }
    return names;
}

}  // namespace

Expected<std::optional<RecordedItem>> Recording::next() {
    if (ended_) return std::nullopt;
    auto item = do_next();
    ended_ = !item || !*item;
    given_ = given_ || !ended_;
    if (!ended_ || !item) return item;
    if (lost_ && !given_) return tl::unexpected(*lost_);
    if (is_beyond_reading())
        warn("so many parts are damaged that the rest is not read");
    else if (losses_ > most_losses_named)
        warn(std::to_string(losses_ - most_losses_named) + " more damaged parts are left out");
    if (!left_out_.empty())
        warn(file_ + ": left out, since no scans are read from it: " + names_of(left_out_));
    return item;
}

void Recording::lose(const tl::unexpected<Fault>& why) {
    if (!lost_) lost_ = why.value();
    if (losses_++ >= most_losses_named) return;
    std::string warning = why.value().why + "; it is left out";
    // A block may be unpacked twice.
    if (std::ranges::find(warnings_, warning) == warnings_.end())
        warn(std::move(warning));
    else
        --losses_;
}

void Recording::leave_out(const std::string& file, const std::string& name,
                          const std::string& type) {
    file_ = file;
    left_out_.insert(printable(name) + " (" + printable(type) + ")");
}

}  // namespace scipd::sim
