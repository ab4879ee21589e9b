// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What differs between Fast DDS 2, of Debian 12, and 3, of Debian 13: names, and how a type is told
// that is nothing but bytes. For the publisher alone.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include <fastcdr/Cdr.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#ifdef SCIPD_WITH_FAST_DDS_3
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
namespace scipd::tests::fast_rtps {
using namespace eprosima::fastdds::rtps;
}
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
namespace scipd::tests::fast_rtps {
using namespace eprosima::fastrtps::rtps;
}
#endif

namespace scipd::tests {

constexpr std::uint32_t longest_message = 1U << 20U;

inline void copy_bytes(const std::string& bytes, fast_rtps::SerializedPayload_t& payload) {
    payload.length = static_cast<std::uint32_t>(bytes.size());
    payload.encapsulation = bytes[1] == 1 ? CDR_LE : CDR_BE;
    std::memcpy(payload.data, bytes.data(), bytes.size());
}

#ifdef SCIPD_WITH_FAST_DDS_3

constexpr auto plain_cdr = eprosima::fastcdr::CdrVersion::DDS_CDR;

inline std::size_t length_of(const eprosima::fastcdr::Cdr& cdr) {
    return cdr.get_serialized_data_length();
}

/// Whatever type, as bytes.
class BytesType : public eprosima::fastdds::dds::TopicDataType {
  public:
    explicit BytesType(const std::string& name) {
        set_name(name);
        max_serialized_type_size = longest_message;
    }

    using Form = eprosima::fastdds::dds::DataRepresentationId_t;
    bool serialize(const void* data, fast_rtps::SerializedPayload_t& payload, Form) override {
        copy_bytes(*static_cast<const std::string*>(data), payload);
        return true;
    }
    bool deserialize(fast_rtps::SerializedPayload_t&, void*) override { return false; }
    std::uint32_t calculate_serialized_size(const void* data, Form) override {
        return static_cast<std::uint32_t>(static_cast<const std::string*>(data)->size());
    }
    void* create_data() override { return new std::string; }
    void delete_data(void* data) override { delete static_cast<std::string*>(data); }
    using Key = fast_rtps::InstanceHandle_t;
    bool compute_key(fast_rtps::SerializedPayload_t&, Key&, bool) override { return false; }
    bool compute_key(const void*, Key&, bool) override { return false; }
};

#else

constexpr auto plain_cdr = eprosima::fastcdr::Cdr::DDS_CDR;

inline std::size_t length_of(const eprosima::fastcdr::Cdr& cdr) {
    return cdr.getSerializedDataLength();
}

/// Whatever type, as bytes.
class BytesType : public eprosima::fastdds::dds::TopicDataType {
  public:
    explicit BytesType(const std::string& name) {
        setName(name.c_str());
        m_typeSize = longest_message;
        m_isGetKeyDefined = false;
    }

    bool serialize(void* data, fast_rtps::SerializedPayload_t* payload) override {
        copy_bytes(*static_cast<std::string*>(data), *payload);
        return true;
    }
    bool deserialize(fast_rtps::SerializedPayload_t*, void*) override { return false; }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return
            [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
    }
    void* createData() override { return new std::string; }
    void deleteData(void* data) override { delete static_cast<std::string*>(data); }
    bool getKey(void*, fast_rtps::InstanceHandle_t*, bool) override { return false; }
};

#endif

}  // namespace scipd::tests
