// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A peer on a TCP port of 127.0.0.1 that is no scanner. It sends fixed bytes to everybody who
// connects, and then stays silent or hangs up.
#pragma once

#include <string>
#include <thread>

namespace scipd::tests {

class ScriptedPeer {
  public:
    enum class Then { hold_on, hang_up };

    explicit ScriptedPeer(std::string greeting, Then then = Then::hold_on);
    ~ScriptedPeer();
    ScriptedPeer(const ScriptedPeer&) = delete;
    ScriptedPeer& operator=(const ScriptedPeer&) = delete;

    [[nodiscard]] std::string target() const;

  private:
    void serve() const;

    std::string greeting_;
    Then then_;
    int listener_;
    std::thread thread_;
};

}  // namespace scipd::tests
