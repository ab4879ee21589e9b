// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/name_hint.h"

#include <vector>

#include "sim/text/near_word.h"
#include "sim/text/quote.h"

namespace scipd::daemon {

std::string name_hint(std::string_view wanted, const std::set<std::string>& names,
                      std::string_view what) {
    if (names.empty()) return "; there are no " + std::string(what);
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (const auto near = sim::meant(wanted, known))
        return "; did you mean " + sim::quote(*near) + '?';
    constexpr std::size_t most = 8;
    std::string list;
    for (std::size_t i = 0; i < known.size() && i < most; ++i)
        list += (i == 0 ? " " : ", ") + sim::printable(known[i], 64);
    return "; " + std::string(what) + " there are" + list + (known.size() > most ? ", ..." : "");
}

}  // namespace scipd::daemon
