// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/daemon/bridges/fast_dds_publisher.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "tests/daemon/bridges/fast_dds_bytes.h"

/// AddressSanitizer asks for these options. Fast DDS 2.9 deletes a writer's statistics by a base
/// class without a virtual destructor.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
    return "new_delete_type_mismatch=0";
}

namespace scipd::tests {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;

std::string dds_name_of(const std::string& type) {
    const auto slash = type.find('/');
    return type.substr(0, slash) + "::msg::dds_::" + type.substr(slash + 1) + '_';
}

dds::DomainParticipantQos on_this_machine() {
    dds::DomainParticipantQos qos;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    fast_rtps::Locator_t here;
    fast_rtps::IPLocator::setIPv4(here, 127, 0, 0, 1);
    qos.wire_protocol().builtin.initialPeersList.push_back(here);
    return qos;
}

/// Writes one message.
template <class Write>
std::string written(Write write, Cdr::Endianness order = Cdr::LITTLE_ENDIANNESS) {
    eprosima::fastcdr::FastBuffer buffer;
    Cdr cdr(buffer, order, plain_cdr);
    cdr.serialize_encapsulation();
    write(cdr);
    return {buffer.getBuffer(), length_of(cdr)};
}

void write_header(Cdr& cdr, const WrittenTransform& pose) {
    cdr << pose.sec << pose.nanosec << pose.parent;
}

void write_numbers(Cdr& cdr, const std::vector<double>& numbers) {
    for (const double number : numbers)
        cdr << number;
}

}  // namespace

struct FastDdsPublisher::Parts {
    dds::DomainParticipant* participant = nullptr;
    dds::Topic* topic = nullptr;
    dds::Publisher* publisher = nullptr;
    dds::DataWriter* writer = nullptr;
};

FastDdsPublisher::FastDdsPublisher(int domain, const std::string& topic, const std::string& type,
                                   PublisherQuality quality)
    : parts_(std::make_unique<Parts>()) {
    auto* const factory = dds::DomainParticipantFactory::get_instance();
    parts_->participant =
        factory->create_participant(static_cast<unsigned>(domain), on_this_machine());
    const std::string name = dds_name_of(type);
    dds::TypeSupport(new BytesType(name)).register_type(parts_->participant);
    parts_->topic = parts_->participant->create_topic("rt" + topic, name, dds::TOPIC_QOS_DEFAULT);
    parts_->publisher = parts_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    dds::DataWriterQos qos;
    qos.reliability().kind =
        quality.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = quality.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                    : dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 1000;
    qos.endpoint().history_memory_policy = fast_rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    parts_->writer = parts_->publisher->create_datawriter(parts_->topic, qos);
}

FastDdsPublisher::~FastDdsPublisher() {
    parts_->participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
}

void FastDdsPublisher::write(const std::string& bytes) {
    std::string copy = bytes;
    parts_->writer->write(&copy);
}

int FastDdsPublisher::subscribers() const {
    dds::PublicationMatchedStatus status;
    parts_->writer->get_publication_matched_status(status);
    return status.current_count;
}

std::string odometry_bytes(const WrittenTransform& pose, const std::vector<double>& twist) {
    return written([&](Cdr& cdr) {
        write_header(cdr, pose);
        cdr << pose.child;
        write_numbers(cdr, pose.xyz_q);
        write_numbers(cdr, std::vector<double>(36));
        write_numbers(cdr, twist);
        write_numbers(cdr, std::vector<double>(36));
    });
}

std::string pose_stamped_bytes(const WrittenTransform& pose) {
    return written([&](Cdr& cdr) {
        write_header(cdr, pose);
        write_numbers(cdr, pose.xyz_q);
    });
}

std::string pose_with_covariance_bytes(const WrittenTransform& pose) {
    return written([&](Cdr& cdr) {
        write_header(cdr, pose);
        write_numbers(cdr, pose.xyz_q);
        write_numbers(cdr, std::vector<double>(36));
    });
}

std::string transform_bytes(const WrittenTransform& pose) {
    return written([&](Cdr& cdr) {
        write_header(cdr, pose);
        cdr << pose.child;
        write_numbers(cdr, pose.xyz_q);
    });
}

std::string transforms_bytes(const std::vector<WrittenTransform>& poses, bool big_endian) {
    const auto write = [&](Cdr& cdr) {
        cdr << static_cast<std::uint32_t>(poses.size());
        for (const WrittenTransform& pose : poses) {
            write_header(cdr, pose);
            cdr << pose.child;
            write_numbers(cdr, pose.xyz_q);
        }
    };
    return written(write, big_endian ? Cdr::BIG_ENDIANNESS : Cdr::LITTLE_ENDIANNESS);
}

std::string clock_bytes(std::int32_t sec, std::uint32_t nanosec) {
    return written([&](Cdr& cdr) { cdr << sec << nanosec; });
}

}  // namespace scipd::tests
