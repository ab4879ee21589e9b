// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Captures of a network (.pcap, .pcapng): the bytes of each TCP connection, both ways, with their
// times. Which of them are conversations with a scanner is not known here. Any thread; nothing
// shared.
#pragma once

#include <memory>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_pcap(InputFile file);

}  // namespace scipd::sim
