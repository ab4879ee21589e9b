// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/pcap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcap/pcap.h>
#include <tins/exceptions.h>
#include <tins/ip.h>
#include <tins/ip_reassembler.h>
#include <tins/ipv6.h>
#include <tins/rawpdu.h>
#include <tins/tcp.h>
#include <tins/tcp_ip/data_tracker.h>

#include "sim/recording/file/byte_reader.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Scanners with Ethernet listen there.
constexpr std::uint16_t scanner_port = 10940;
/// More are left out: each costs memory, and a capture may hold millions.
constexpr std::size_t most_connections = 50'000;
/// Fragments of packets that may wait for their others.
constexpr std::size_t most_fragments = 1024;
/// Memory of the segments that wait in all connections.
constexpr std::size_t most_waiting = std::size_t{64} << 20;

struct ClosePcap {
    void operator()(pcap_t* pcap) const { pcap_close(pcap); }
};
using Pcap = std::unique_ptr<pcap_t, ClosePcap>;

struct Link {
    int type;
    std::size_t header;     ///< bytes before the packet
    bool tells_of = false;  ///< with the type of the packet at its end
};
constexpr std::array links = {
    Link{DLT_NULL, 4}, Link{DLT_EN10MB, 14, true},    Link{DLT_RAW, 0},         Link{DLT_LOOP, 4},
    Link{DLT_IPV4, 0}, Link{DLT_LINUX_SLL, 16, true}, Link{DLT_LINUX_SLL2, 20}, Link{DLT_IPV6, 0},
};

/// The packet of IP in a frame, behind any tags of VLANs; empty if there is none. libtins would
/// take tags by recursion, as many as the frame holds, and knows no DLT_LINUX_SLL2.
std::string_view ip_packet(const Link& link, std::string_view frame) {
    ByteReader reader(frame, std::endian::big);
    reader.skip(link.header);
    if (!link.tells_of) return reader.rest();
    ByteReader types(frame.substr(std::min(link.header - 2, frame.size())), std::endian::big);
    auto type = types.number<std::uint16_t>();
    while ((type == 0x8100 || type == 0x88A8) && !types.too_short()) {
        types.skip(2);
        type = types.number<std::uint16_t>();
    }
    return type == 0x0800 || type == 0x86DD ? types.rest() : std::string_view{};
}

/// One way of a connection, put together again: segments that come twice count once, those that
/// come too early wait, and what the capture has lost is skipped once too much waits for it.
class OneWay {
  public:
    explicit OneWay(Way way) : way_(way) {}

    /// The connection opens: its bytes begin behind this number. Without it the first segment is
    /// the beginning.
    void open(std::uint32_t sequence) {
        if (!tracker_) tracker_.emplace(sequence + 1);
    }

    void add(std::uint32_t sequence, const Tins::RawPDU::payload_type& payload, HostTime time) {
        if (!tracker_) tracker_.emplace(sequence);
        // Numbers wrap: the nearer way round is the one that is meant.
        const auto ahead = static_cast<std::int32_t>(sequence - tracker_->sequence_number());
        if (ahead > 0) times_.try_emplace(position_ + static_cast<std::uint64_t>(ahead), time);
        tracker_->process_payload(sequence, payload);
        collect(time);
        while (waiting() > most_of_one)
            skip_gap();
    }

    /// Goes on behind all that is lost.
    void finish() {
        while (waiting() > 0)
            skip_gap();
    }

    /// The bytes that are in order, with the times of their segments.
    [[nodiscard]] std::vector<RecordedBytes> take() { return std::exchange(ready_, {}); }
    /// Count of bytes that were skipped.
    [[nodiscard]] std::uint64_t lost() const { return lost_; }
    /// Memory of what waits.
    [[nodiscard]] std::size_t waiting() const {
        constexpr std::size_t of_segment = 200;
        if (!tracker_) return 0;
        return tracker_->total_buffered_bytes() + tracker_->buffered_payload().size() * of_segment;
    }

  private:
    /// A receiver's window is mostly smaller.
    static constexpr std::size_t most_of_one = std::size_t{512} << 10;

    void collect(HostTime time) {
        const auto& payload = tracker_->payload();
        std::string_view bytes(reinterpret_cast<const char*>(payload.data()), payload.size());
        while (!bytes.empty()) {
            auto next = times_.begin();
            for (; next != times_.end() && next->first <= position_; next = times_.erase(next))
                time = next->second;
            const auto size = next == times_.end()
                                  ? bytes.size()
                                  : std::min(bytes.size(), next->first - position_);
            ready_.push_back({way_, time, std::string(bytes.substr(0, size))});
            position_ += size;
            bytes.remove_prefix(size);
        }
        tracker_->payload().clear();
    }

    void skip_gap() {
        const auto& waiting = tracker_->buffered_payload();
        auto next = waiting.lower_bound(tracker_->sequence_number());
        if (next == waiting.end()) next = waiting.begin();
        const std::uint32_t sequence = next->first;
        const std::uint32_t gap = sequence - tracker_->sequence_number();
        lost_ += gap;
        position_ += gap;
        tracker_->sequence_number(sequence);
        tracker_->process_payload(sequence, {});
        collect({});
    }

    Way way_;
    std::optional<Tins::TCPIP::DataTracker> tracker_;
    std::uint64_t position_ = 0;               ///< of the next byte in the stream
    std::map<std::uint64_t, HostTime> times_;  ///< of segments that wait, by position
    std::uint64_t lost_ = 0;
    std::vector<RecordedBytes> ready_;
};

class Capture final : public Recording {
  public:
    Capture(InputFile file, Pcap pcap, const Link& link)
        : Recording("pcap"), file_(std::move(file)), pcap_(std::move(pcap)), link_(link) {}

  private:
    /// "192.168.0.10:10940" or "[fe80::1]:10940": of the scanner, then of the client.
    using Ends = std::pair<std::string, std::string>;
    struct Connection {
        std::optional<std::size_t> stream;  ///< once there are bytes
        std::optional<std::uint32_t> syn;   ///< sequence of the client's
        OneWay to_scanner{Way::to_scanner};
        OneWay from_scanner{Way::from_scanner};
    };
    using Connections = std::map<Ends, Connection>;

    Next do_next() override {
        while (ready_.empty()) {
            if (ended_) return std::nullopt;
            if (read_packet()) continue;
            while (!connections_.empty())
                close(connections_.begin());
            ended_ = true;
        }
        RecordedItem item = std::move(ready_.front());
        ready_.pop_front();
        return item;
    }

    /// False at the end of the file.
    bool read_packet() {
        pcap_pkthdr* head = nullptr;
        const unsigned char* bytes = nullptr;
        const int result = pcap_next_ex(pcap_.get(), &head, &bytes);
        if (result == PCAP_ERROR)
            warn(file_.name() + ": byte " + std::to_string(std::ftell(pcap_file(pcap_.get()))) +
                 ": what follows cannot be read: " + printable(pcap_geterr(pcap_.get())));
        if (result != 1) return false;
        const std::string_view frame(reinterpret_cast<const char*>(bytes), head->caplen);
        // The file was opened for nanoseconds, which this field then holds.
        take_packet(ip_packet(link_, frame), host_time_at(head->ts.tv_sec, head->ts.tv_usec));
        return true;
    }

    /// One that is damaged is as good as lost.
    void take_packet(std::string_view packet, HostTime time) try {
        constexpr std::size_t protocol = 9;  // its place in IPv4; others may be tunnels in tunnels
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(packet.data());
        const auto size = static_cast<std::uint32_t>(packet.size());
        if (size <= protocol) return;
        if (bytes[0] >> 4 == 6) {
            const Tins::IPv6 ip(bytes, size);
            take_segment(ip, "[" + ip.src_addr().to_string() + "]:",
                         "[" + ip.dst_addr().to_string() + "]:", time);
        } else if (bytes[0] >> 4 == 4 && bytes[protocol] == IPPROTO_TCP) {
            Tins::IP ip(bytes, size);
            if (is_whole(ip))
                take_segment(ip, ip.src_addr().to_string() + ":", ip.dst_addr().to_string() + ":",
                             time);
        }
    } catch (const Tins::exception_base&) {
    }

    /// Returns true if the packet is whole: no fragment, or the last one, which now is all of them.
    bool is_whole(Tins::IP& ip) {
        const auto status = fragments_.process(ip);
        if (status == Tins::IPv4Reassembler::FRAGMENTED && ++waiting_fragments_ > most_fragments)
            fragments_.clear_streams();
        if (status == Tins::IPv4Reassembler::REASSEMBLED || waiting_fragments_ > most_fragments)
            waiting_fragments_ = 0;
        return status != Tins::IPv4Reassembler::FRAGMENTED;
    }

    void take_segment(const Tins::PDU& packet, std::string from, std::string to, HostTime time) {
        const auto* const tcp = packet.find_pdu<Tins::TCP>();
        if (tcp == nullptr) return;
        from += std::to_string(tcp->sport());
        to += std::to_string(tcp->dport());
        const bool syn = tcp->get_flag(Tins::TCP::SYN) != 0;
        const bool from_scanner =
            connections_.contains({from, to}) ||
            (!connections_.contains({to, from}) && is_from_scanner(*tcp, syn));
        const Ends ends = from_scanner ? Ends{from, to} : Ends{to, from};
        Connection* const connection = connection_of(ends, *tcp);
        if (connection == nullptr) return;
        OneWay& way = from_scanner ? connection->from_scanner : connection->to_scanner;
        if (syn) return way.open(tcp->seq());
        const auto* const payload = tcp->find_pdu<Tins::RawPDU>();
        if (payload == nullptr || payload->payload().empty()) return;
        if (!connection->stream) connection->stream = add_connection(ends);
        waiting_ -= way.waiting();
        way.add(tcp->seq(), payload->payload(), time);
        if (waiting_ + way.waiting() > most_waiting) way.finish();
        waiting_ += way.waiting();
        give(way, *connection->stream);
    }

    /// The side that asks to open is the client. In the middle of a connection the port tells, else
    /// that of a server is the lower one.
    static bool is_from_scanner(const Tins::TCP& tcp, bool syn) {
        if (syn) return tcp.get_flag(Tins::TCP::ACK) != 0;
        if (tcp.sport() == scanner_port) return true;
        return tcp.dport() != scanner_port && tcp.sport() < tcp.dport();
    }

    /// Returns nullopt if there are too many.
    Connection* connection_of(const Ends& ends, const Tins::TCP& tcp) {
        const bool asks = tcp.flags() & Tins::TCP::SYN && !(tcp.flags() & Tins::TCP::ACK);
        auto found = connections_.find(ends);
        // Ports are used again.
        if (asks && found != connections_.end() && found->second.syn != tcp.seq()) {
            close(found);
            found = connections_.end();
        }
        if (found == connections_.end()) {
            if (std::max(connections_.size(), streams().size()) >= most_connections) {
                if (!std::exchange(too_many_, true))
                    warn(file_.name() + ": has more than " + std::to_string(most_connections) +
                         " TCP connections; the others are left out");
                return nullptr;
            }
            found = connections_.emplace(ends, Connection{}).first;
        }
        if (asks) found->second.syn = tcp.seq();
        return &found->second;
    }

    std::size_t add_connection(const Ends& ends) {
        std::string name = ends.first + " with " + ends.second;
        if (const int number = ++counts_[ends]; number > 1) name += " #" + std::to_string(number);
        return add_stream(
            {.name = std::move(name), .type = "TCP", .has_scans = false, .has_bytes = true});
    }

    void give(OneWay& way, std::size_t stream) {
        for (RecordedBytes& bytes : way.take())
            ready_.push_back({stream, std::move(bytes)});
    }

    void close(Connections::iterator which) {
        Connection& connection = which->second;
        std::uint64_t lost = 0;
        for (OneWay* const way : {&connection.to_scanner, &connection.from_scanner}) {
            waiting_ -= way->waiting();
            way->finish();
            lost += way->lost();
            if (connection.stream) give(*way, *connection.stream);
        }
        if (lost > 0)
            warn(file_.name() + ": " + stream(*connection.stream).name + ": the capture lacks " +
                 std::to_string(lost) + " bytes");
        connections_.erase(which);
    }

    InputFile file_;  ///< the library reads it, as long as it lives
    Pcap pcap_;
    Link link_;
    Tins::IPv4Reassembler fragments_;
    std::size_t waiting_fragments_ = 0;
    Connections connections_;
    std::map<Ends, int> counts_;
    std::size_t waiting_ = 0;  ///< memory of the segments that wait
    std::deque<RecordedItem> ready_;
    bool too_many_ = false;
    bool ended_ = false;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_pcap(InputFile file) {
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    std::FILE* const handed_over = file.release();
    Pcap pcap(pcap_fopen_offline_with_tstamp_precision(handed_over, PCAP_TSTAMP_PRECISION_NANO,
                                                       error.data()));
    if (!pcap) {
        std::fclose(handed_over);
        return file.refuse("is no capture of a network: " + printable(error.data()));
    }
    const int type = pcap_datalink(pcap.get());
    const auto link = std::ranges::find(links, type, &Link::type);
    if (link == links.end()) {
        const char* const name = pcap_datalink_val_to_name(type);
        return file.refuse("was captured on a link of type " +
                           (name == nullptr ? std::to_string(type) : std::string(name)) +
                           ", which is not read; capture on Ethernet or on \"any\"");
    }
    return std::make_unique<Capture>(std::move(file), std::move(pcap), *link);
}

}  // namespace scipd::sim
