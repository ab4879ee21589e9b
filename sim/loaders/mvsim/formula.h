// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What MVSim calculates in a world file: `${NAME}`, `${NAME|otherwise}` and `$f{2*sin(pi/4)+NAME}`.
// Neither commands, `$(...)`, nor the environment, nor chance. Any thread; nothing shared.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace scipd::sim {

using Variables = std::map<std::string, std::string, std::less<>>;

/// Throws std::invalid_argument, saying what cannot be calculated.
double formula(std::string_view text, const Variables& variables);

/// The text with the values of all that it asks for. Throws std::invalid_argument.
std::string substituted(std::string_view text, const Variables& variables);

}  // namespace scipd::sim
