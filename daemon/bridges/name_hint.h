// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which name may have been meant where one is not there. Any thread; nothing shared.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace scipd::daemon {

/// "; did you mean '/odom'?", or "; topics there are /odom, /tf", of at most eight, or "; there are
/// no topics". `what` is what the names are of.
std::string name_hint(std::string_view wanted, const std::set<std::string>& names,
                      std::string_view what);

}  // namespace scipd::daemon
