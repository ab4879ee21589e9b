// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The WebSocket /wire: it tells each request and reply of one scanner, as soon as it goes over the
// wire. Nobody listens there while no client is here. A client that is too slow misses messages,
// and the next one tells how many. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "daemon/api/scan_stream.h"
#include "daemon/http/web_socket.h"
#include "daemon/wire/wire_tap.h"

namespace scipd::daemon {

class WireStream {
  public:
    using Ways = ScanStream::Ways;

    /// A scanner's end of it. The stream must outlive it. It is made, and goes, while no sensor
    /// does anything.
    class Tap {
      public:
        Tap(WireStream& stream, std::string name, std::unique_ptr<WireTap> wire);
        Tap(const Tap&) = delete;
        Tap& operator=(const Tap&) = delete;
        ~Tap() { std::erase(stream_.taps_, this); }

      private:
        friend class WireStream;

        WireStream& stream_;
        std::string name_;
        std::unique_ptr<WireTap> wire_;
        bool listens_ = false;
    };

    explicit WireStream(Ways ways) : ways_(std::move(ways)) {}
    WireStream(const WireStream&) = delete;
    WireStream& operator=(const WireStream&) = delete;

    std::unique_ptr<Conversation> open(const std::string& sensor, WebSocket& socket);

  private:
    class Listener;

    void follow(Tap& tap);
    void follow_all();
    /// `missed`: how many before this one are lost.
    void tell(const std::string& sensor, const WireEntry& entry, std::uint64_t missed);

    Ways ways_;
    std::vector<Tap*> taps_;
    std::vector<Listener*> listeners_;
};

}  // namespace scipd::daemon
