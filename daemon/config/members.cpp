// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/members.h"

namespace scipd::daemon {

sim::Expected<std::vector<Field>> items(const Field& list) {
    if (!list.value.IsSequence() || list.value.size() > longest_list)
        return sim::refuse("must be a list of at most 64, in brackets");
    std::vector<Field> fields;
    for (const YAML::Node& item : list.value)
        fields.push_back({list.key, list.path, item.Mark().line + 1, item});
    return fields;
}

}  // namespace scipd::daemon
