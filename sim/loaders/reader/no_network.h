// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes from this process what no reader of files needs: the network, other processes, and, unless
// it is to run one, programs (seccomp). For scipd-read alone.
#pragma once

namespace scipd::sim {

enum class Programs { none, may_run };

/// From now on such calls fail here and in the children of this process. False: the kernel cannot
/// do that, and nothing has changed.
bool forbid_network(Programs programs);

}  // namespace scipd::sim
