// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The WebSocket /stream: it sends every scan of all sensors, or of one, to whoever subscribes, as
// soon as it is measured, and tells of a fault on purpose as soon as it has acted. While somebody
// subscribes scans are cast, whether a driver wants them or not. A message is made once for all
// clients. A client that is too slow loses whole messages, of all sensors alike; scans that are
// lost are counted. Lives on the I/O thread; what sensors tell on another thread is carried there,
// and some of it is lost where this thread is too slow.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "daemon/api/lane.h"
#include "daemon/http/backlog.h"
#include "daemon/http/web_socket.h"

namespace scipd::daemon {

class Device;
class FaultLog;
class StaringSensor;

class ScanStream {
  public:
    /// How to get from the stream's thread to those of sensors, and back.
    struct Ways {
        using Call = std::function<void()>;
        /// Calls it while no sensor does anything.
        std::function<void(const Call&)> to_sensors = [](const Call& call) { call(); };
        /// Calls it on the stream's thread, from any thread.
        std::function<void(Call)> to_stream = [](const Call& call) { call(); };
    };

    /// A sensor's end of the stream. The stream and the sensor must outlive it.
    class Tap {
      public:
        Tap(ScanStream& stream, std::string name, Device& device);
        Tap(ScanStream& stream, std::string name, StaringSensor& sensor);
        Tap(const Tap&) = delete;
        Tap& operator=(const Tap&) = delete;
        ~Tap();

        /// Sends what comes into the log as well. The log must outlive the tap.
        void follow(FaultLog& faults);
        /// Scans that a subscriber, or the stream, was too slow for.
        [[nodiscard]] std::uint64_t lost() const { return source_->lost + lane_.lost(); }

      private:
        friend class ScanStream;
        using Watch = std::function<void(bool wanted)>;

        Tap(ScanStream& stream, std::string name, Watch watch);
        /// Has the sensor tell the stream of every measurement, as long as that is wanted.
        template <class Record, class Sensor>
        Watch watch_of(Sensor& sensor);

        ScanStream& stream_;
        std::shared_ptr<Backlog::Source> source_;
        Lane lane_;
        /// Faults have a source of their own under this name: many at once cost no client a scan.
        std::shared_ptr<Backlog::Source> faults_source_;
        FaultLog* faults_ = nullptr;
        Watch watch_;
    };

    explicit ScanStream(SharedLimits limits = std::make_shared<Limits>());
    ScanStream(SharedLimits limits, Ways ways);
    ScanStream(const ScanStream&) = delete;
    ScanStream& operator=(const ScanStream&) = delete;

    /// Somebody else who is told of the entries of the logs that taps follow: fault_event().
    using OnFault = std::function<void(const std::string& event)>;
    void on_fault(OnFault callback) { on_fault_ = std::move(callback); }

    /// Sends what one sensor measures; `sensor` empty: what all measure.
    std::unique_ptr<Conversation> subscribe(const std::string& sensor, WebSocket& socket);

  private:
    class Subscriber;

    /// Its sensor casts as long as somebody subscribes.
    void follow(Tap& tap);
    void follow_all();
    [[nodiscard]] bool wanted(const std::string& sensor) const;
    void send(const std::shared_ptr<Backlog::Source>& source, std::string message);
    void tell_fault(const std::shared_ptr<Backlog::Source>& source, const std::string& event);
    void count_lost(Backlog::Number number, const Backlog::Message& message);
    void forget_what_all_have();

    Ways ways_;
    Lane::Load load_ = std::make_shared<Lane::Load::element_type>(0);
    Backlog backlog_;
    OnFault on_fault_;
    std::vector<Tap*> taps_;
    std::vector<Subscriber*> subscribers_;
};

}  // namespace scipd::daemon
