// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A publisher of transforms as rmw_cyclonedds makes one: with a type that it tells, and by code
// that idlc has made of it. On 127.0.0.1 alone. Has threads of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scipd::tests {

struct CycloneTransform {
    std::int32_t sec = 0;
    std::string parent;
    std::string child;
    double x = 0.0;  ///< all else is the origin
};

class CyclonePublisher {
  public:
    /// `for_good`: of /tf_static. Others guarantee nothing.
    CyclonePublisher(unsigned domain, const std::string& topic, bool for_good);
    CyclonePublisher(const CyclonePublisher&) = delete;
    CyclonePublisher& operator=(const CyclonePublisher&) = delete;
    ~CyclonePublisher();

    void write(const std::vector<CycloneTransform>& transforms);

  private:
    int domain_ = 0;
    int participant_ = 0;
    int writer_ = 0;
};

}  // namespace scipd::tests
