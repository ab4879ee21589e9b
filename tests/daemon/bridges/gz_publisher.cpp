// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/daemon/bridges/gz_publisher.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include <unistd.h>

#ifdef SCIPD_WITH_IGNITION
#include <ignition/transport/Node.hh>
namespace transport = ignition::transport;
#else
#include <gz/transport/Node.hh>
namespace transport = gz::transport;
#endif

namespace scipd::tests {

void keep_gz_to_this_test() {
    const std::string partition = "scipd_" + std::to_string(getpid());
    for (const std::string prefix : {"GZ", "IGN"}) {
        setenv((prefix + "_PARTITION").c_str(), partition.c_str(), 1);
        setenv((prefix + "_IP").c_str(), "127.0.0.1", 1);
    }
}

struct GzPublisher::Parts {
    std::string type;
    transport::Node node;
    transport::Node::Publisher publisher;
};

GzPublisher::GzPublisher(const std::string& topic, const std::string& type)
    : parts_(std::make_unique<Parts>()) {
    parts_->type = type;
    parts_->publisher = parts_->node.Advertise(topic, type);
}

GzPublisher::~GzPublisher() = default;

void GzPublisher::write(const std::string& bytes) {
    parts_->publisher.PublishRaw(bytes, parts_->type);
}

bool GzPublisher::is_heard() const {
    for (int i = 0; i < 200 && !parts_->publisher.HasConnections(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return parts_->publisher.HasConnections();
}

}  // namespace scipd::tests
