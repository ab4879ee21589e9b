// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/dds_bytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

namespace scipd::daemon {
namespace {

struct Message : ddsi_serdata {
    Message(const ddsi_sertype* of_type, ddsi_serdata_kind of_kind) : ddsi_serdata{} {
        ddsi_serdata_init(this, of_type, of_kind);
        hash = of_type->serdata_basehash;
    }

    std::string bytes;
};

const Message& message_in(const ddsi_serdata* data) {
    return *static_cast<const Message*>(data);
}

/// Pieces may overlap, says Cyclone DDS.
void add_pieces(const nn_rdata* piece, std::string& bytes) {
    for (; piece != nullptr; piece = piece->nextfrag) {
        if (piece->maxp1 <= bytes.size()) continue;
        const unsigned char* const begin =
            NN_RMSG_PAYLOADOFF(piece->rmsg, NN_RDATA_PAYLOAD_OFF(piece));
        bytes.append(reinterpret_cast<const char*>(begin) + (bytes.size() - piece->min),
                     piece->maxp1 - bytes.size());
    }
}

ddsi_serdata* from_network(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* piece,
                           std::size_t size) {
    auto message = std::make_unique<Message>(type, kind);
    message->bytes.reserve(size);
    add_pieces(piece, message->bytes);
    return message.release();
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind,
                          ddsrt_msg_iovlen_t count, const ddsrt_iovec_t* pieces, std::size_t size) {
    auto message = std::make_unique<Message>(type, kind);
    message->bytes.reserve(size);
    for (ddsrt_msg_iovlen_t i = 0; i < count; ++i)
        message->bytes.append(static_cast<const char*>(pieces[i].iov_base), pieces[i].iov_len);
    return message.release();
}

ddsi_serdata* from_key(const ddsi_sertype* type, const ddsi_keyhash* /*key*/) {
    return new Message(type, SDK_KEY);
}

ddsi_serdata* without_type(const ddsi_serdata* data) {
    auto* const untyped = new Message(data->type, SDK_KEY);
    untyped->type = nullptr;
    return untyped;
}

// Another reader of this process may want the bytes, with up to three behind them.
void copy_bytes(const ddsi_serdata* data, std::size_t from, std::size_t size, void* to) {
    const std::string& bytes = message_in(data).bytes;
    std::memset(to, 0, size);
    if (from < bytes.size())
        std::memcpy(to, bytes.data() + from, std::min(size, bytes.size() - from));
}

ddsi_serdata* lend_bytes(const ddsi_serdata* data, std::size_t from, std::size_t size,
                         ddsrt_iovec_t* lent) {
    lent->iov_base = new char[size];
    lent->iov_len = size;
    copy_bytes(data, from, size, lent->iov_base);
    return ddsi_serdata_ref(data);
}

void take_back(ddsi_serdata* data, const ddsrt_iovec_t* lent) {
    delete[] static_cast<char*>(lent->iov_base);
    ddsi_serdata_unref(data);
}

std::size_t print(const ddsi_sertype* /*type*/, const ddsi_serdata* data, char* to,
                  std::size_t size) {
    const std::size_t bytes = message_in(data).bytes.size();
    return static_cast<std::size_t>(std::snprintf(to, size, "%zu bytes", bytes));
}

const ddsi_serdata_ops message_functions = [] {
    ddsi_serdata_ops functions{};
    functions.eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; };
    functions.get_size = [](const ddsi_serdata* data) {
        return static_cast<std::uint32_t>(message_in(data).bytes.size());
    };
    functions.from_ser = from_network;
    functions.from_ser_iov = from_pieces;
    functions.from_keyhash = from_key;
    functions.from_sample = [](const ddsi_sertype*, ddsi_serdata_kind,
                               const void*) -> ddsi_serdata* { return nullptr; };
    functions.to_ser = copy_bytes;
    functions.to_ser_ref = lend_bytes;
    functions.to_ser_unref = take_back;
    functions.to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; };
    functions.to_untyped = without_type;
    functions.untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**,
                                     void*) { return true; };
    functions.free = [](ddsi_serdata* data) { delete static_cast<Message*>(data); };
    functions.print = print;
    functions.get_keyhash = [](const ddsi_serdata*, ddsi_keyhash* key, bool) {
        std::memset(key, 0, sizeof(*key));
    };
    return functions;
}();

const ddsi_sertype_ops type_functions = [] {
    ddsi_sertype_ops functions{};
    functions.version = ddsi_sertype_v0;
    functions.free = [](ddsi_sertype* type) {
        ddsi_sertype_fini(type);
        delete type;
    };
    functions.zero_samples = [](const ddsi_sertype*, void*, std::size_t) {};
    functions.realloc_samples = [](void** to, const ddsi_sertype*, void*, std::size_t,
                                   std::size_t count) { std::fill_n(to, count, nullptr); };
    functions.free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {};
    functions.equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; };
    functions.hash = [](const ddsi_sertype*) { return std::uint32_t{0}; };
    return functions;
}();

}  // namespace

ddsi_sertype* make_type_of_bytes(const std::string& name) {
    auto* const type = new ddsi_sertype{};
    constexpr bool without_keys = true;
    ddsi_sertype_init(type, name.c_str(), &type_functions, &message_functions, without_keys);
    return type;
}

std::string_view bytes_of(const ddsi_serdata* message) {
    return message_in(message).bytes;
}

}  // namespace scipd::daemon
