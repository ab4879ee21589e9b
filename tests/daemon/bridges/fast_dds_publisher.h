// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A publisher of ROS 2 as rmw_fastrtps makes one: another vendor's DDS, and its own writer of CDR.
// On 127.0.0.1 alone. Has threads of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scipd::tests {

struct PublisherQuality {
    bool reliable = true;
    bool transient_local = false;
};

struct WrittenTransform {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
    std::string parent;
    std::string child;
    std::vector<double> xyz_q;  ///< seven numbers
};

class FastDdsPublisher {
  public:
    /// `type` is "nav_msgs/Odometry".
    FastDdsPublisher(int domain, const std::string& topic, const std::string& type,
                     PublisherQuality quality = {});
    FastDdsPublisher(const FastDdsPublisher&) = delete;
    FastDdsPublisher& operator=(const FastDdsPublisher&) = delete;
    ~FastDdsPublisher();

    /// The bytes of a message, with their header of four bytes.
    void write(const std::string& bytes);
    [[nodiscard]] int subscribers() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Messages as Fast CDR writes them.
std::string odometry_bytes(const WrittenTransform& pose, const std::vector<double>& twist);
std::string pose_stamped_bytes(const WrittenTransform& pose);
std::string pose_with_covariance_bytes(const WrittenTransform& pose);
std::string transform_bytes(const WrittenTransform& pose);
std::string transforms_bytes(const std::vector<WrittenTransform>& poses, bool big_endian = false);
std::string clock_bytes(std::int32_t sec, std::uint32_t nanosec);

}  // namespace scipd::tests
