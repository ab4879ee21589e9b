// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The <experimental:params> of an <include>: what it adds to, changes in, takes from or replaces in
// the model that it brings. Any thread; nothing shared.
#pragma once

#include <functional>
#include <string>

#include <tinyxml2.h>

namespace scipd::sim {

/// Changes `model`, a copy of one's own. What finds nothing there is skipped, and told to `skipped`
/// with its element.
void apply_params(
    const tinyxml2::XMLElement& params, tinyxml2::XMLElement& model,
    const std::function<void(const tinyxml2::XMLElement& param, const std::string& why)>& skipped);

}  // namespace scipd::sim
