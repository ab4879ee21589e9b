// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Topics of Gazebo, by its transport: ignition-transport 11 or gz-transport 12 and later, which
// hear each other. A subscription to a type hears nothing of the other generation, which calls its
// types otherwise, so scipd takes the bytes of any type. The library heeds GZ_PARTITION, GZ_IP and
// GZ_RELAY, or IGN_PARTITION and so on, itself.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#ifdef SCIPD_WITH_IGNITION
#include <ignition/transport/Node.hh>
namespace transport = ignition::transport;
#else
#include <gz/transport/Node.hh>
namespace transport = gz::transport;
#endif

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"
#include "daemon/bridges/gz_message.h"
#include "daemon/bridges/name_hint.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

// Whoever publishes is known a second or two after the start.
constexpr auto time_to_be_found = 3s;
constexpr auto look_every = 1s;

/// gz-transport 13 and later also tell who listens, and warn who does not ask.
template <class Node>
std::vector<transport::MessagePublisher> publishers_of(const Node& node, const std::string& topic) {
    std::vector<transport::MessagePublisher> publishers;
    std::vector<transport::MessagePublisher> subscribers;
    if constexpr (requires { node.TopicInfo(topic, publishers, subscribers); })
        node.TopicInfo(topic, publishers, subscribers);
    else
        node.TopicInfo(topic, publishers);
    return publishers;
}

class GzBus : public Bus {
  public:
    GzBus(const std::vector<std::string>& topics, BusListener& listener)
        : topic_(topics.front()), listener_(listener) {
        for (const std::string& topic : topics) {
            const auto hear = [this](const char* bytes, std::size_t size,
                                     const transport::MessageInfo& info) {
                hand_on(info.Type(), {bytes, size});
            };
            if (!node_.SubscribeRaw(topic, hear))
                throw std::runtime_error("cannot listen to Gazebo's topic " + sim::quote(topic));
        }
        looker_ = std::thread([this] { look(); });
    }

    // Without the node's topics no call is under way any more.
    ~GzBus() override {
        {
            const std::scoped_lock lock(mutex_);
            stopping_ = true;
        }
        stop_.notify_all();
        looker_.join();
        for (const std::string& topic : node_.SubscribedTopics())
            node_.Unsubscribe(topic);
        // A call may still be running on a thread of the library, which takes this lock.
        const std::scoped_lock lock(calling_);
        ended_ = true;
    }

  private:
    void hand_on(const std::string& type, std::string_view bytes) {
        const std::scoped_lock lock(calling_);
        if (ended_) return;
        auto heard = read_gz_message(type, bytes);
        if (heard) {
            listener_.hear(*std::move(heard));
        } else {
            listener_.refuse(heard.error().why);
        }
    }

    void look() {
        std::unique_lock lock(mutex_);
        std::string told;
        if (stop_.wait_for(lock, time_to_be_found, [this] { return stopping_; })) return;
        do {
            std::string trouble = this->trouble();
            if (trouble == told) continue;
            told = trouble;
            listener_.tell_trouble(std::move(trouble));
        } while (!stop_.wait_for(lock, look_every, [this] { return stopping_; }));
    }

    [[nodiscard]] std::string trouble() const {
        std::vector<std::string> topics;
        node_.TopicList(topics);
        std::set<std::string> readable;
        std::string other_type;
        for (const std::string& topic : topics) {
            for (const auto& publisher : publishers_of(node_, topic)) {
                if (is_readable_gz_type(publisher.MsgTypeName()))
                    readable.insert(topic);
                else if (topic == topic_)
                    other_type = publisher.MsgTypeName();
            }
        }
        if (readable.contains(topic_)) return {};
        if (!other_type.empty())
            return topic_ + " is of " + sim::printable(other_type) +
                   ", which holds no pose that scipd can read";
        return "no publisher of " + topic_ + name_hint(topic_, readable, "topics");
    }

    const std::string topic_;
    BusListener& listener_;
    std::mutex mutex_;
    std::condition_variable stop_;
    bool stopping_ = false;  ///< protected by mutex_
    std::mutex calling_;
    bool ended_ = false;  ///< protected by calling_
    transport::Node node_;
    std::thread looker_;
};

}  // namespace

sim::Expected<> check_gz_is_built() {
    return {};
}

std::unique_ptr<Bus> listen_to_gz(const std::vector<std::string>& topics, BusListener& listener) {
    return std::make_unique<GzBus>(topics, listener);
}

}  // namespace scipd::daemon
