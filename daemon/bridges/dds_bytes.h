// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has Cyclone DDS take messages of any type as the bytes that they come as, which it would
// otherwise need generated code for. For reading alone: nothing can be written so. Called by the
// threads of Cyclone DDS.
#pragma once

#include <string>
#include <string_view>

struct ddsi_serdata;
struct ddsi_sertype;

namespace scipd::daemon {

/// A type of this name, without keys, as all types of ROS 2 are. For dds_create_topic_sertype(),
/// which owns it from then on.
ddsi_sertype* make_type_of_bytes(const std::string& name);

/// A message that dds_takecdr() gave of such a type, with the header of CDR; good as long as the
/// message is.
std::string_view bytes_of(const ddsi_serdata* message);

}  // namespace scipd::daemon
