// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/unseen_media.h"

namespace scipd::daemon {

std::vector<std::string> media_notices(const Config& config) {
    if (config.media.empty() || config.any_sees_light()) return {};
    return {config.place_of("media") + std::string(unseen_media)};
}

}  // namespace scipd::daemon
