// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/daemon/bridges/cyclone_publisher.h"

#include <stdexcept>

#include <dds/dds.h>

#include "transforms.h"  // by idlc

namespace scipd::tests {
namespace {

constexpr const char* on_this_machine = R"(<CycloneDDS><Domain>
<General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>)";

dds_entity_t made(dds_entity_t entity) {
    if (entity < 0) throw std::runtime_error(dds_strretcode(-entity));
    return entity;
}

dds_qos_t* quality(bool for_good) {
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, for_good ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_SECS(1));
    dds_qset_durability(qos, for_good ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    return qos;
}

}  // namespace

CyclonePublisher::CyclonePublisher(unsigned domain, const std::string& topic, bool for_good) {
    // Where there is one already, it is of another of these.
    domain_ = dds_create_domain(domain, on_this_machine);
    participant_ = made(dds_create_participant(domain, nullptr, nullptr));
    const dds_entity_t dds_topic =
        made(dds_create_topic(participant_, &tf2_msgs_msg_dds__TFMessage__desc,
                              ("rt" + topic).c_str(), nullptr, nullptr));
    dds_qos_t* const qos = quality(for_good);
    const dds_entity_t writer = dds_create_writer(participant_, dds_topic, qos, nullptr);
    dds_delete_qos(qos);
    writer_ = made(writer);
}

CyclonePublisher::~CyclonePublisher() {
    dds_delete(participant_);
    if (domain_ > 0) dds_delete(domain_);
}

void CyclonePublisher::write(const std::vector<CycloneTransform>& transforms) {
    std::vector<geometry_msgs_msg_dds__TransformStamped_> written(transforms.size());
    for (std::size_t i = 0; i < transforms.size(); ++i) {
        written[i].header.stamp.sec = transforms[i].sec;
        written[i].header.frame_id = const_cast<char*>(transforms[i].parent.c_str());
        written[i].child_frame_id = const_cast<char*>(transforms[i].child.c_str());
        written[i].transform.translation.x = transforms[i].x;
        written[i].transform.rotation.w = 1.0;
    }
    const auto count = static_cast<std::uint32_t>(written.size());
    const tf2_msgs_msg_dds__TFMessage_ message{{count, count, written.data(), false}};
    made(dds_write(writer_, &message));
}

}  // namespace scipd::tests
