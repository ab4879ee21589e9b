// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which of scipd's models made a recording, as far as the recording says. Values; one thread.
#pragma once

#include <string>

#include "daemon/models/model.h"
#include "tools/analysis/scan_table.h"

namespace scipd::tools {

struct Kind {
    const daemon::Model* model = nullptr;  ///< one of daemon::models()
    bool known = false;  ///< the recording or the user names it; else it is the nearest one
    std::string from;    ///< "measured (the recording says UST-10LX)"
};

/// `named`: what the user says; empty: what the recording says, else the model whose steps, angles,
/// range and codes come closest. Throws WrongInput where there is no such model.
[[nodiscard]] Kind kind_of(const ScanTable& readings, const std::string& named);

/// Takes from the model what the recording does not say of its steps and limits, and makes codes of
/// what is beyond the limits. If the recording has codes, the model's stand where a format has NaN,
/// an infinity or 0 for them.
void complete(const daemon::Model& model, ScanTable& readings);

}  // namespace scipd::tools
