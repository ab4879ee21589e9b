// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Calculates the expressions of an MVSim world: `${NAME}`, `${NAME|otherwise}` and
// `$f{2*sin(pi/4)+NAME}`. Commands (`$(...)`), the environment and random numbers are not
// supported. Any thread; nothing shared.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace scipd::sim {

using Variables = std::map<std::string, std::string, std::less<>>;

/// Throws std::invalid_argument, saying what cannot be calculated.
double formula(std::string_view text, const Variables& variables);

/// The text with all its expressions replaced by their values. Throws std::invalid_argument.
std::string substituted(std::string_view text, const Variables& variables);

}  // namespace scipd::sim
