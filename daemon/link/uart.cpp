// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/uart.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace scipd::daemon {
namespace {

constexpr int data_bits = 8;
constexpr std::size_t frame_bits = data_bits + 2;

/// The line while bytes are sent; its time counts their bits.
class Waveform {
  public:
    explicit Waveform(std::string_view sent) : sent_(sent), bits_(sent.size() * frame_bits) {}

    [[nodiscard]] bool high(double time) const { return is_high(static_cast<std::size_t>(time)); }

    [[nodiscard]] std::optional<std::size_t> falling_edge_from(std::size_t bit) const {
        for (; bit < bits_; ++bit) {
            if (!is_high(bit) && (bit == 0 || is_high(bit - 1))) return bit;
        }
        return std::nullopt;
    }

  private:
    [[nodiscard]] bool is_high(std::size_t bit) const {
        if (bit >= bits_) return true;
        const std::size_t place = bit % frame_bits;
        if (place == 0) return false;
        if (place == frame_bits - 1) return true;
        return ((static_cast<unsigned char>(sent_[bit / frame_bits]) >> (place - 1)) & 1U) != 0;
    }

    std::string_view sent_;
    std::size_t bits_;
};

}  // namespace

std::string heard(std::string_view sent, int sent_at, int read_at) {
    if (sent_at == read_at) return std::string(sent);
    const Waveform line(sent);
    const double bit_time = static_cast<double>(sent_at) / read_at;
    std::string received;
    std::size_t from = 0;
    while (const auto edge = line.falling_edge_from(from)) {
        const auto middle_of = [&](int bit) {
            return static_cast<double>(*edge) + (bit + 0.5) * bit_time;
        };
        int last = 0;
        // An edge whose low level is over by then is no start bit but a disturbance.
        if (!line.high(middle_of(0))) {
            unsigned byte = 0;
            for (int bit = 0; bit < data_bits; ++bit)
                byte |= line.high(middle_of(bit + 1)) ? 1U << bit : 0U;
            last = data_bits + 1;
            // Without a stop bit it is no byte. A tty hands out 0 in its place (POSIX, where
            // neither IGNPAR nor PARMRK is set).
            received += line.high(middle_of(last)) ? static_cast<char>(byte) : '\0';
        }
        from = static_cast<std::size_t>(std::floor(middle_of(last))) + 1;
    }
    return received;
}

// Deduced: MRPT's driver, made for a URG-04LX on RS-232, sends QT at a wrong rate and then, without
// a line break between, its next request at the right one.
std::string heard_by_scanner(std::string_view sent, int sent_at, int read_at) {
    std::string bytes = heard(sent, sent_at, read_at);
    if (sent_at != read_at) {
        std::erase_if(bytes,
                      [](char c) { return c == '\0' || static_cast<unsigned char>(c) > 127; });
    }
    return bytes;
}

}  // namespace scipd::daemon
