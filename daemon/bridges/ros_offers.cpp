// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/ros_offers.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "daemon/bridges/name_hint.h"
#include "daemon/bridges/ros_cdr.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

bool is_readable(const RosOffer& offer) {
    const auto types = readable_ros_types();
    return std::ranges::find(types, ros_type_of(offer.dds_type)) != types.end();
}

}  // namespace

bool RosOffers::add(const std::string& key, const RosOffer& offer) {
    const auto [place, is_new] = offers_.try_emplace(key, offer);
    if (is_new || place->second == offer) return is_new;
    place->second = offer;
    return true;
}

std::optional<RosOffer> RosOffers::common(const std::string& topic) const {
    std::optional<RosOffer> common;
    for (const auto& [key, offer] : offers_) {
        if (offer.topic != topic || !is_readable(offer)) continue;
        if (!common) common = offer;
        if (offer.dds_type != common->dds_type) continue;
        common->reliable = common->reliable && offer.reliable;
        common->keeps_last = common->keeps_last && offer.keeps_last;
    }
    return common;
}

std::string RosOffers::trouble_with(const std::string& topic) const {
    std::set<std::string> others;
    for (const auto& [key, offer] : offers_) {
        if (is_readable(offer)) others.insert(offer.topic);
    }
    if (others.contains(topic)) return {};
    for (const auto& [key, offer] : offers_) {
        if (offer.topic == topic)
            return sim::printable(topic) + " is of " + sim::printable(ros_type_of(offer.dds_type)) +
                   ", which holds no pose that scipd can read";
    }
    return "no publisher of " + sim::printable(topic) + name_hint(topic, others, "topics");
}

}  // namespace scipd::daemon
