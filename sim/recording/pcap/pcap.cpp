// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/pcap/pcap.h"

#include <array>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <pcap/pcap.h>

#include "sim/recording/pcap/tcp_segment.h"
#include "sim/recording/pcap/tcp_stream.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Scanners with Ethernet listen there.
constexpr std::uint16_t scanner_port = 10940;

struct ClosePcap {
    void operator()(pcap_t* pcap) const { pcap_close(pcap); }
};
using Pcap = std::unique_ptr<pcap_t, ClosePcap>;

/// The ends of a connection, whichever of them sends.
struct Ends {
    Endpoint scanner;
    Endpoint client;

    bool operator<(const Ends& other) const {
        return std::tie(scanner, client) < std::tie(other.scanner, other.client);
    }
};

/// Who asks to open is the client. In the middle of a connection the port tells, else that of a
/// server is the lower one.
bool is_from_scanner(const TcpSegment& segment) {
    if (segment.syn) return segment.ack;
    if (segment.from.port == scanner_port) return true;
    return segment.to.port != scanner_port && segment.from.port < segment.to.port;
}

class Capture final : public Recording {
  public:
    Capture(InputFile file, Pcap pcap)
        : Recording("pcap"),
          file_(std::move(file)),
          pcap_(std::move(pcap)),
          link_type_(pcap_datalink(pcap_.get())) {}

  private:
    struct Connection {
        std::size_t stream = 0;
        TcpStream to_scanner;
        TcpStream from_scanner;
    };

    Next do_next() override {
        while (ready_.empty()) {
            if (ended_) return std::nullopt;
            if (!read_packet()) finish();
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
            warn(file_.name() + ": byte " + std::to_string(byte_reached()) +
                 ": what follows cannot be read: " + printable(pcap_geterr(pcap_.get())));
        if (result != 1) return false;
        const std::string_view packet(reinterpret_cast<const char*>(bytes), head->caplen);
        // The file was opened for nanoseconds, which this field then holds.
        const HostTime time = host_time_at(head->ts.tv_sec, head->ts.tv_usec);
        if (const auto segment = tcp_segment(link_type_, packet)) take(*segment, time);
        return true;
    }

    [[nodiscard]] long byte_reached() const { return std::ftell(pcap_file(pcap_.get())); }

    void take(const TcpSegment& segment, HostTime time) {
        const bool from_scanner = from_scanner_end(segment);
        const Ends ends =
            from_scanner ? Ends{segment.from, segment.to} : Ends{segment.to, segment.from};
        // Ports are used again.
        if (segment.syn && !segment.ack) close(ends);
        const auto [found, is_new] = connections_.try_emplace(ends);
        Connection& connection = found->second;
        if (is_new) connection.stream = add_connection(ends);
        TcpStream& way = from_scanner ? connection.from_scanner : connection.to_scanner;
        if (segment.syn) return way.open(segment.sequence);
        give(connection.stream, from_scanner ? Way::from_scanner : Way::to_scanner,
             way.add(segment.sequence, time, segment.payload));
    }

    /// A connection that is known has its ends already.
    bool from_scanner_end(const TcpSegment& segment) const {
        if (connections_.contains({segment.from, segment.to})) return true;
        if (connections_.contains({segment.to, segment.from})) return false;
        return is_from_scanner(segment);
    }

    std::size_t add_connection(const Ends& ends) {
        std::string name = text_of(ends.scanner) + " with " + text_of(ends.client);
        if (const int number = ++counts_[ends]; number > 1) name += " #" + std::to_string(number);
        return add_stream(
            {.name = std::move(name), .type = "TCP", .has_scans = false, .has_bytes = true});
    }

    void give(std::size_t stream, Way way, std::vector<TcpStream::Piece> pieces) {
        for (TcpStream::Piece& piece : pieces)
            ready_.push_back({stream, RecordedBytes{way, piece.time, std::move(piece.bytes)}});
    }

    void close(const Ends& ends) {
        const auto found = connections_.find(ends);
        if (found == connections_.end()) return;
        Connection& connection = found->second;
        give(connection.stream, Way::to_scanner, connection.to_scanner.finish());
        give(connection.stream, Way::from_scanner, connection.from_scanner.finish());
        const std::uint64_t lost = connection.to_scanner.lost() + connection.from_scanner.lost();
        if (lost > 0)
            warn(file_.name() + ": " + stream(connection.stream).name + ": the capture lacks " +
                 std::to_string(lost) + " bytes");
        connections_.erase(found);
    }

    void finish() {
        while (!connections_.empty())
            close(Ends(connections_.begin()->first));
        ended_ = true;
    }

    InputFile file_;  ///< the library reads it, as long as it lives
    Pcap pcap_;
    int link_type_;
    std::map<Ends, Connection> connections_;
    std::map<Ends, int> counts_;
    std::deque<RecordedItem> ready_;
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
    if (const int type = pcap_datalink(pcap.get()); !is_known_link(type)) {
        const char* const link = pcap_datalink_val_to_name(type);
        return file.refuse("was captured on a link of type " +
                           (link == nullptr ? std::to_string(type) : std::string(link)) +
                           ", which is not read; capture on Ethernet or on \"any\"");
    }
    return std::make_unique<Capture>(std::move(file), std::move(pcap));
}

}  // namespace scipd::sim
