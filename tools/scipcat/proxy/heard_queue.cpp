// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/heard_queue.h"

#include <algorithm>

namespace scipd::tools {

void HeardQueue::push(Heard::What what, sim::HostTime time, std::string_view bytes) {
    constexpr std::size_t most = capacity / 2;
    for (; bytes.size() > most; bytes.remove_prefix(most))
        push(what, time, bytes.substr(0, most));
    const Head head{what, static_cast<std::uint32_t>(bytes.size()),
                    time.time_since_epoch().count()};
    const std::size_t begin = pushed_;
    const std::size_t end = begin + sizeof head + bytes.size();
    for (std::size_t popped = popped_; end - popped > capacity; popped = popped_)
        popped_.wait(popped);
    put(begin, &head, sizeof head);
    put(begin + sizeof head, bytes.data(), bytes.size());
    pushed_ = end;
}

std::optional<Heard> HeardQueue::pop() {
    const std::size_t begin = popped_;
    if (begin == pushed_) return std::nullopt;
    Head head{};
    get(begin, &head, sizeof head);
    Heard heard{head.what, sim::HostTime(sim::HostTime::duration(head.time_ns)),
                std::string(head.size, '\0')};
    get(begin + sizeof head, heard.bytes.data(), head.size);
    popped_ = begin + sizeof head + head.size;
    popped_.notify_one();
    return heard;
}

// What does not fit before the end of the ring goes on at its beginning. Bytes may be none, from
// nowhere, which memcpy() must not get.
void HeardQueue::put(std::size_t at, const void* from, std::size_t count) {
    const auto* bytes = static_cast<const char*>(from);
    const std::size_t place = at % capacity;
    const std::size_t first = std::min(count, capacity - place);
    std::copy_n(bytes, first, ring_.get() + place);
    std::copy_n(bytes + first, count - first, ring_.get());
}

void HeardQueue::get(std::size_t at, void* to, std::size_t count) const {
    auto* bytes = static_cast<char*>(to);
    const std::size_t place = at % capacity;
    const std::size_t first = std::min(count, capacity - place);
    std::copy_n(ring_.get() + place, first, bytes);
    std::copy_n(ring_.get(), count - first, bytes + first);
}

}  // namespace scipd::tools
