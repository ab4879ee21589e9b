// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// An identity as keys and values, which formats of their own metadata hold: model, serial, and so
// on, then each line of the scanner's answers as VV.KEY, PP.KEY and II.KEY. Any thread; nothing
// shared.
#pragma once

#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim {

/// What is not known is left out.
[[nodiscard]] Entries entries_of(const ScannerIdentity& identity);

/// Leaves out what it does not know.
[[nodiscard]] ScannerIdentity identity_in(const Entries& entries);

}  // namespace scipd::sim
