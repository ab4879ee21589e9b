// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Neighbouring steps that share one value.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_cluster = "SCIP 2.0 (C-42-03320B) p. 10";
constexpr std::string_view recorded_cluster = "a recorded UTM-30LX: 271 values of 1081 steps";

using protocol::client::ScanMessage;
using Values = std::vector<std::uint32_t>;

/// parse_scan() counts: the last group may be shorter.
Finding clusters(Subject& subject, const std::string& command, const std::string& window,
                 const std::string& cluster) {
    if (command == "GD") return is_scan(subject.scan(window, cluster));
    if (!subject.facts().knows(command)) return not_applicable("it does not know " + command);
    subject.measure();
    return is_scan(subject.ask(command + window + cluster));
}

/// The median of each value over some scans.
Values medians(const std::vector<ScanMessage>& scans) {
    Values medians;
    for (std::size_t i = 0; i < scans.front().distances_mm.size(); ++i) {
        Values values;
        for (const ScanMessage& scan : scans)
            values.push_back(scan.distances_mm.at(i));
        std::ranges::sort(values);
        medians.push_back(values[values.size() / 2]);
    }
    return medians;
}

Values distances(Subject& subject, const std::string& cluster) {
    constexpr int count = 3;
    subject.rest();
    subject.stream("MD" + subject.all() + cluster + "003");
    return medians(subject.scans(count));
}

struct Agreement {
    int told = 0;  ///< groups whose nearest is told well from all else
    int kept = 0;  ///< of these, in how many the value is that
};

/// Looks at groups with an edge in them, where the mean is far from the nearest, and the first of
/// the group as often as not.
Agreement compare(const Values& steps, const Values& groups, std::size_t cluster,
                  std::uint32_t least, std::uint32_t most) {
    constexpr std::uint32_t noise_mm = 80;
    Agreement agreement;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::size_t end = std::min((i + 1) * cluster, steps.size());
        Values group(steps.begin() + static_cast<std::ptrdiff_t>(i * cluster),
                     steps.begin() + static_cast<std::ptrdiff_t>(end));
        std::erase_if(group, [&](std::uint32_t v) { return v < least || v > most; });
        if (group.empty()) continue;
        const auto [nearest, farthest] = std::ranges::minmax(group);
        if (farthest < nearest + 3 * noise_mm) continue;
        ++agreement.told;
        const std::uint32_t tolerance = noise_mm + nearest / 50;
        if (groups[i] + tolerance >= nearest && groups[i] <= nearest + tolerance) ++agreement.kept;
    }
    return agreement;
}

Finding nearest_of_group(Subject& subject) {
    constexpr std::size_t cluster = 16;
    constexpr int fewest = 4;
    const auto limit = [&](const char* key) {
        return static_cast<std::uint32_t>(std::stoul("0" + subject.facts().text(key)));
    };
    const Values steps = distances(subject, "01");
    const Values groups = distances(subject, "16");
    const Agreement agreement = compare(steps, groups, cluster, limit("DMIN"), limit("DMAX"));
    if (agreement.told < fewest)
        return not_applicable("it sees too few edges to tell the nearest of a group");
    return require(agreement.kept * 10 >= agreement.told * 7,
                   "of " + std::to_string(agreement.told) + " groups with an edge only " +
                       std::to_string(agreement.kept) + " have the distance of their nearest step");
}

constexpr Check table_of_clusters[] = {
    {"7.1", "a cluster of 00 is one of 01", "recorded UST-20LX; urg_library",
     [](Subject& subject) { return clusters(subject, "GD", subject.window(9), "00"); }},
    {"7.2", "nine steps in twos are five values", recorded_cluster,
     [](Subject& subject) { return clusters(subject, "GD", subject.window(9), "02"); }},
    {"7.3", "all steps in fours, the last group as short as need be", recorded_cluster,
     [](Subject& subject) { return clusters(subject, "GD", subject.all(), "04"); }},
    {"7.4", "all steps in groups of 99", spec_cluster,
     [](Subject& subject) { return clusters(subject, "GD", subject.all(), "99"); }},
    {"7.5", "a cluster that is larger than the window is one value", spec_cluster,
     [](Subject& subject) { return clusters(subject, "GD", subject.window(5), "10"); }},
    {"7.6", "GE brings one pair of values a group", recorded_cluster,
     [](Subject& subject) { return clusters(subject, "GE", subject.all(), "04"); }},
    {"7.7", "HD brings the echoes of one step a group", "urg_library",
     [](Subject& subject) { return clusters(subject, "HD", subject.all(), "04"); }},
    {"7.8", "a stream has clusters as well", recorded_cluster,
     [](Subject& subject) { return subject.expect_scans("MD" + subject.all() + "030", 2); }},
    {"7.9", "the value of a group is its nearest distance", spec_cluster, nearest_of_group},
};

}  // namespace

std::span<const Check> cluster_checks() {
    return table_of_clusters;
}

}  // namespace scipd::tools::checks
