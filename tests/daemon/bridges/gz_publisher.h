// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Publishes bytes by Gazebo's transport, on 127.0.0.1 and for this process and its children alone.
#pragma once

#include <memory>
#include <string>

namespace scipd::tests {

/// To be called before anything of the transport: tests that run side by side do not hear each
/// other.
void keep_gz_to_this_test();

class GzPublisher {
  public:
    GzPublisher(const std::string& topic, const std::string& type);
    ~GzPublisher();
    GzPublisher(const GzPublisher&) = delete;
    GzPublisher& operator=(const GzPublisher&) = delete;

    void write(const std::string& bytes);
    /// Waits until somebody listens; of another process, its sockets may not be connected yet.
    [[nodiscard]] bool is_heard() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace scipd::tests
