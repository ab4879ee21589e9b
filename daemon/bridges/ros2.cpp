// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Topics of ROS 2, over DDS: a topic /odom of nav_msgs/Odometry is rt/odom of
// nav_msgs::msg::dds_::Odometry_ there (ROS design, "Topic and Service name mapping to DDS"). Which
// type a topic has, and how it is offered, tell those who publish it.
#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"
#include "daemon/bridges/dds_bytes.h"
#include "daemon/bridges/ros_cdr.h"
#include "daemon/bridges/ros_offers.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view prefix = "rt";
constexpr int messages_at_once = 64;
// What a reader keeps at most. More than that is lost, or waits at a reliable publisher.
constexpr int most_kept = 1000;
// Whoever publishes is known a second or two after the start.
constexpr auto time_to_be_found = 3s;

/// Keeps to this machine, as ROS_LOCALHOST_ONLY of ROS 2 does; that needs no multicast.
constexpr const char* localhost_only = R"(<CycloneDDS><Domain>
<General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>)";

dds_entity_t made(dds_entity_t entity, const char* what) {
    if (entity >= 0) return entity;
    throw std::runtime_error(std::string("cannot listen to ROS 2: ") + what + ": " +
                             dds_strretcode(-entity));
}

dds_domainid_t domain_of_environment() {
    const char* const said = std::getenv("ROS_DOMAIN_ID");
    if (said == nullptr || *said == '\0') return 0;
    const std::string_view text = said;
    dds_domainid_t domain = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), domain);
    // The ports of a domain follow from its number, and end there.
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || domain > 232)
        throw std::runtime_error("ROS_DOMAIN_ID must be a number from 0 to 232, not " +
                                 sim::quote(text));
    return domain;
}

/// One topic that is listened to.
struct Ear {
    std::string topic;
    bool for_good = false;
    dds_entity_t reader = 0;  ///< 0: no readable type is published
    dds_entity_t dds_topic = 0;
    std::optional<RosOffer> as_offered;  ///< what the reader was made for
};

class Ros2Bus : public Bus {
  public:
    Ros2Bus(const RosTopics& topics, BusListener& listener)
        : listener_(listener), domain_(domain_of_environment()) {
        ears_.push_back({.topic = topics.topic});
        if (!topics.fixed.empty()) ears_.push_back({.topic = topics.fixed, .for_good = true});
        if (!topics.clock.empty()) ears_.push_back({.topic = topics.clock});
        const char* const local = std::getenv("ROS_LOCALHOST_ONLY");
        // There may be such a domain already, of another robot.
        if (local != nullptr && std::string_view(local) == "1")
            (void)dds_create_domain(domain_, localhost_only);
        participant_ = made(dds_create_participant(domain_, nullptr, nullptr), "no participant");
        try {
            publications_ = made(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
                                                   nullptr, nullptr),
                                 "no list of topics");
            waitset_ = made(dds_create_waitset(participant_), "no waitset");
            stop_ = made(dds_create_guardcondition(participant_), "no condition");
            attach(stop_);
            attach(publications_);
        } catch (...) {
            dds_delete(participant_);
            throw;
        }
        thread_ = std::thread([this] { run(); });
    }

    ~Ros2Bus() override {
        stopping_ = true;
        dds_set_guardcondition(stop_, true);
        thread_.join();
        dds_delete(participant_);
    }

  private:
    void attach(dds_entity_t entity) {
        dds_set_status_mask(entity, DDS_DATA_AVAILABLE_STATUS);
        made(dds_waitset_attach(waitset_, entity, 0), "nothing to wait for");
    }

    void run() {
        while (!stopping_) {
            dds_waitset_wait(waitset_, nullptr, 0, DDS_MSECS(500));
            if (take_publications()) {
                for (Ear& ear : ears_)
                    listen(ear);
            }
            for (const Ear& ear : ears_)
                take_messages(ear);
            tell_trouble();
        }
    }

    /// Whether anything has changed.
    bool take_publications() {
        std::array<void*, messages_at_once> samples{};
        std::array<dds_sample_info_t, messages_at_once> infos;
        bool changed = false;
        for (;;) {
            const int taken = dds_take(publications_, samples.data(), infos.data(), samples.size(),
                                       messages_at_once);
            if (taken <= 0) return changed;
            for (int i = 0; i < taken; ++i)
                changed |= note(*static_cast<dds_builtintopic_endpoint_t*>(samples[i]), infos[i]);
            dds_return_loan(publications_, samples.data(), taken);
        }
    }

    bool note(const dds_builtintopic_endpoint_t& publication, const dds_sample_info_t& info) {
        const std::string key(reinterpret_cast<const char*>(publication.key.v),
                              sizeof(publication.key.v));
        if (!info.valid_data || info.instance_state != DDS_ALIVE_INSTANCE_STATE)
            return offers_.remove(key);
        const std::string_view topic = publication.topic_name;
        if (!topic.starts_with(std::string(prefix) + '/')) return false;
        dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
        dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
        dds_qget_reliability(publication.qos, &reliability, nullptr);
        dds_qget_durability(publication.qos, &durability);
        return offers_.add(key, {.topic = std::string(topic.substr(prefix.size())),
                                 .dds_type = publication.type_name,
                                 .reliable = reliability == DDS_RELIABILITY_RELIABLE,
                                 .keeps_last = durability >= DDS_DURABILITY_TRANSIENT_LOCAL});
    }

    void listen(Ear& ear) {
        const auto offer = offers_.common(ear.topic);
        if (!offer || offer == ear.as_offered) return;
        close(ear);
        ear.as_offered = offer;
        ddsi_sertype* type = make_type_of_bytes(offer->dds_type);
        ear.dds_topic =
            dds_create_topic_sertype(participant_, (std::string(prefix) + ear.topic).c_str(), &type,
                                     nullptr, nullptr, nullptr);
        dds_qos_t* const qos = dds_create_qos();
        dds_qset_reliability(
            qos, offer->reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
            DDS_SECS(1));
        dds_qset_durability(
            qos, offer->keeps_last ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
        dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
        dds_qset_resource_limits(qos, most_kept, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
        const std::array<dds_data_representation_id_t, 2> forms{DDS_DATA_REPRESENTATION_XCDR1,
                                                                DDS_DATA_REPRESENTATION_XCDR2};
        dds_qset_data_representation(qos, forms.size(), forms.data());
        ear.reader = dds_create_reader(participant_, ear.dds_topic, qos, nullptr);
        dds_delete_qos(qos);
        if (ear.reader > 0) {
            dds_set_status_mask(ear.reader, DDS_DATA_AVAILABLE_STATUS);
            dds_waitset_attach(waitset_, ear.reader, 0);
        }
    }

    void close(Ear& ear) {
        if (ear.reader > 0) {
            dds_waitset_detach(waitset_, ear.reader);
            dds_delete(ear.reader);
        }
        if (ear.dds_topic > 0) dds_delete(ear.dds_topic);
        ear.reader = ear.dds_topic = 0;
    }

    void take_messages(const Ear& ear) {
        if (ear.reader <= 0) return;
        const std::string type = ros_type_of(ear.as_offered->dds_type);
        std::array<ddsi_serdata*, messages_at_once> messages{};
        std::array<dds_sample_info_t, messages_at_once> infos;
        while (!stopping_) {
            const int taken = dds_takecdr(ear.reader, messages.data(), messages_at_once,
                                          infos.data(), DDS_ANY_STATE);
            for (int i = 0; i < taken; ++i) {
                if (infos[i].valid_data) hand_on(ear, type, bytes_of(messages[i]));
                ddsi_serdata_unref(messages[i]);
            }
            if (taken < messages_at_once) return;
        }
    }

    void hand_on(const Ear& ear, const std::string& type, std::string_view bytes) {
        auto heard = read_ros_message(type, bytes);
        if (!heard) return listener_.refuse(heard.error().why);
        heard->for_good = ear.for_good;
        listener_.hear(*std::move(heard));
    }

    void tell_trouble() {
        if (std::chrono::steady_clock::now() - begun_ < time_to_be_found) return;
        std::string trouble = offers_.trouble_with(ears_.front().topic);
        if (!trouble.empty()) trouble += " (ROS domain " + std::to_string(domain_) + ')';
        if (trouble == told_) return;
        told_ = trouble;
        listener_.tell_trouble(std::move(trouble));
    }

    BusListener& listener_;
    dds_domainid_t domain_;
    dds_entity_t participant_ = 0;
    dds_entity_t publications_ = 0;
    dds_entity_t waitset_ = 0;
    dds_entity_t stop_ = 0;
    RosOffers offers_;
    std::vector<Ear> ears_;
    std::string told_;
    const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::atomic<bool> stopping_ = false;
    std::thread thread_;
};

}  // namespace

sim::Expected<> check_ros2_is_built() {
    return {};
}

std::unique_ptr<Bus> listen_to_ros2(const RosTopics& topics, BusListener& listener) {
    return std::make_unique<Ros2Bus>(topics, listener);
}

}  // namespace scipd::daemon
