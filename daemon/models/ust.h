// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

#include "daemon/models/model.h"

namespace scipd::daemon {

/// What all UST have in common, as far as is known: that of the UST-10LX.
protocol::DeviceProfile ust_profile(const std::string& name, const std::string& serial);

Model ust_10lx();
Model ust_20lx();

}  // namespace scipd::daemon
