// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/source_report.h"

namespace scipd::daemon {

std::string text_of(const PoseSource& source) {
    switch (source.kind) {
        case PoseSource::Kind::udp:
            return "udp:" + text_of(source.address);
        case PoseSource::Kind::file:
            return source.file.string();
        case PoseSource::Kind::standard_input:
            return "-";
        case PoseSource::Kind::vda5050:
            return "vda5050:" + source.vehicle;
        case PoseSource::Kind::gz:
            return "gz:" + source.topic;
        case PoseSource::Kind::ros2:
            return "ros2:" + source.topic;
        case PoseSource::Kind::rosbridge:
            break;
    }
    return "rosbridge:ws://" + text_of(source.address) + source.topic;
}

}  // namespace scipd::daemon
