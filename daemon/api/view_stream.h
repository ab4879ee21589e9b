// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The WebSocket /view: what pages draw. A page says which sensors it wants to see, and gets one
// frame of each, and the next when it has drawn that: what is measured meanwhile it never gets. So
// a frame is made only when somebody can take it, where its sensor lives; nothing waits in a queue.
// Beside that a page hears where things are, when something has moved, and of faults on purpose.
// What is on its way to all pages has one bound; a page that does not read is cut. Lives on the I/O
// thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "daemon/api/fault_text.h"
#include "daemon/api/scan_stream.h"
#include "daemon/api/view_frame.h"
#include "daemon/api/world_view.h"
#include "daemon/clock/clock.h"
#include "daemon/http/unsent.h"
#include "daemon/http/web_socket.h"
#include "daemon/limits/limits.h"

namespace scipd::daemon {

class ViewStream {
  public:
    using Ways = ScanStream::Ways;

    /// A sensor's end of it. The stream and the sensor must outlive it.
    class Tap {
      public:
        Tap(ViewStream& stream, std::string name, Device& device);
        Tap(ViewStream& stream, std::string name, StaringSensor& sensor);
        Tap(const Tap&) = delete;
        Tap& operator=(const Tap&) = delete;
        ~Tap();

      private:
        friend class ViewStream;
        /// What the next frame shall have. Its sensor takes it away where it makes that frame.
        using Order = std::shared_ptr<std::atomic<ViewDepth>>;

        void join();
        template <class Record, class Sensor>
        void watch_with(Sensor& sensor);

        ViewStream& stream_;
        std::string name_;
        Order order_ = std::make_shared<std::atomic<ViewDepth>>(ViewDepth::none);
        std::function<void(bool wanted)> watch_;
    };

    /// `wall` tells when to look what has moved.
    ViewStream(Ways ways, Clock& wall, SharedLimits limits = std::make_shared<Limits>());
    ViewStream(const ViewStream&) = delete;
    ViewStream& operator=(const ViewStream&) = delete;
    ~ViewStream();

    using Look = std::function<WorldView()>;
    /// `look` tells what is where.
    std::unique_ptr<Conversation> open(WebSocket& page, const Look& look);
    /// Something goes wrong on purpose: a fault_event(). Pages hear of it at once, of further ones
    /// together and a little later.
    void tell_fault(const std::string& event);

  private:
    class Page;
    class Pacer;

    void follow_all();
    void follow(Tap& tap) const;
    /// Has its sensor make a frame if a page can take one.
    void order(Tap& tap) const;
    void order(const std::string& sensor) const;
    void send(const std::string& sensor, std::string frame);
    /// Whether so much more may be on its way to pages.
    bool has_room(std::size_t bytes);
    void look();
    /// And again, while pages are there.
    void look_later();

    Ways ways_;
    Clock& wall_;
    SharedLimits limits_;
    std::unique_ptr<Clock::Alarm> next_look_;
    std::vector<Tap*> taps_;
    std::vector<Page*> pages_;
    std::uint32_t frames_ = 0;
    Unsent unsent_;
    bool lacks_room_ = false;  ///< something was not sent for that
    FaultNews faults_;
};

}  // namespace scipd::daemon
