// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands in for the files of the page in a build without them.
#include "daemon/web/page_files.h"

namespace scipd::daemon {

std::span<const PageFile> page_files() {
    return {};
}

}  // namespace scipd::daemon
