// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What tells one firmware from another: the answers to a fixed list of questions in four states,
// without what differs from unit to unit or with time. Whoever answers them, a scanner or a model
// of one, is asked the same. None of the questions sets anything. A value; no thread rule.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace scipd::tools::checks {

/// The whole reply to a request, without scans that came before it. Nothing: there is none.
using Ask = std::function<std::optional<std::string>(const std::string& request)>;

/// What was asked in which state, and what came of it.
using Fingerprint = std::map<std::string, std::string>;

[[nodiscard]] Fingerprint take_fingerprint(const Ask& ask);

/// How many answers of one are those of the other.
[[nodiscard]] std::size_t alike(const Fingerprint& a, const Fingerprint& b);

}  // namespace scipd::tools::checks
