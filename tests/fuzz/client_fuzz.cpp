// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as what a scanner sends to the client. The first byte says how to cut the rest into
// pieces, and whether the right sums are added to its lines. However the bytes are cut, the
// messages must be those of a plain split. A message is damaged exactly if a line of it is wrong;
// of any other, the bytes can be told from its parts, and from those of its scan. A driver that
// asks all its questions ends, and throws nothing but an Error.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/char_code.h"
#include "protocol/checksum.h"
#include "protocol/client/decoder.h"
#include "protocol/client/device_info.h"
#include "protocol/client/driver.h"
#include "protocol/client/scan_message.h"

namespace {

using namespace scipd::protocol;
using namespace scipd::protocol::client;

void demand(bool fact) {
    if (!fact) std::abort();
}

using Lines = std::vector<std::string>;

/// The lines of each message that has come to its empty line.
std::vector<Lines> plain_split(std::string_view bytes) {
    std::vector<Lines> messages;
    Lines lines;
    for (auto end = bytes.find('\n'); end != bytes.npos; end = bytes.find('\n')) {
        if (end > 0) {
            lines.emplace_back(bytes.substr(0, end));
        } else if (!lines.empty()) {
            messages.push_back(std::exchange(lines, {}));
        }
        bytes.remove_prefix(end + 1);
    }
    return messages;
}

bool has_entries(std::string_view echo) {
    return echo.starts_with("VV") || echo.starts_with("PP") || echo.starts_with("II");
}

std::string summed(std::string_view text, std::string_view tail = "") {
    return std::string(text) + std::string(tail) + checksum(text);
}

/// The bytes with a sum behind each line but echoes and empty ones.
std::string with_sums(std::string_view bytes) {
    std::string all;
    for (const Lines& message : plain_split(bytes)) {
        all += message.front() + '\n';
        for (std::size_t i = 1; i < message.size(); ++i) {
            const bool entry = i > 1 && has_entries(message.front());
            all += summed(message[i], entry ? ";" : "") + '\n';
        }
        all += '\n';
    }
    return all;
}

/// The lines on the wire of a message that is not damaged.
Lines on_the_wire(const Message& message) {
    const bool scip_1 = message.status.size() == 1;
    Lines lines{message.echo, scip_1 ? message.status : summed(message.status)};
    for (const std::string& line : message.lines)
        lines.push_back(scip_1 ? line : summed(line, has_entries(message.echo) ? ";" : ""));
    return lines;
}

/// Whether a line of a message is wrong, in the order in which they come.
bool damaged(const Lines& lines) {
    std::size_t size = 0;
    for (const std::string& line : lines) {
        size += line.size();
        if (line.size() > Decoder::max_line || size > Decoder::max_message) return true;
    }
    if (lines.size() < 2) return true;
    const std::string& status = lines[1];
    if (status.size() == 1) return false;
    if (status.size() != 3 || status[2] != checksum(status.substr(0, 2))) return true;
    return std::any_of(lines.begin() + 2, lines.end(), [&](const std::string& line) {
        const std::size_t tail = has_entries(lines[0]) ? 2 : 1;
        const bool ends = tail == 1 || (line.size() >= 2 && line[line.size() - 2] == ';');
        return !ends || line.back() != checksum(line.substr(0, line.size() - tail));
    });
}

std::string data_of(const ScanMessage& scan) {
    const ScanRequest& request = scan.request;
    std::string data;
    const auto append = [&](std::uint32_t value) {
        demand(value <= max_encoded(request.width));
        append_encoded(data, value, request.width);
    };
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i) {
        append(scan.distances_mm[i]);
        if (request.intensity) append(scan.intensities.at(i));
        if (!request.echoes) continue;
        for (const Echo& echo : scan.further_echoes.at(i)) {
            data += '&';
            append(echo.distance_mm);
            if (request.intensity) append(echo.intensity);
        }
    }
    return data;
}

/// The lines behind the status, as one text.
std::string written_again(const ScanMessage& scan) {
    std::string text;
    if (scan.request.io_lines) {
        append_encoded(text, scan.inputs, 3);
        append_encoded(text, scan.outputs, 3);
    }
    if (scan.request.microseconds)
        append_encoded(text, scan.stamp_us, 11);
    else
        append_encoded(text, scan.stamp_ms, 4);
    return text + data_of(scan);
}

void demand_same_scan(const Message& message) {
    const auto parsed = parse_scan(message);
    const auto* const scan = std::get_if<ScanMessage>(&parsed);
    if (scan == nullptr) return demand(!std::get<std::string>(parsed).empty());
    demand(!message.damage && scan->distances_mm.size() == scan->request.groups());
    std::string came;
    for (const std::string& line : message.lines)
        came += line;
    demand(written_again(*scan) == came);
}

void demand_usable(const Message& message) {
    (void)parse_version(message);
    (void)parse_state(message);
    const auto parsed = parse_parameters(message);
    if (const auto* const parameters = std::get_if<Parameters>(&parsed)) {
        demand(parameters->ares > 0 && parameters->amin <= parameters->amax);
        demand(parameters->angle_rad(parameters->afrt) == 0);
    }
}

void decode_in_pieces(std::string_view bytes, std::size_t piece) {
    const std::vector<Lines> expected = plain_split(bytes);
    Decoder decoder;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
        std::string_view part = bytes.substr(begin, piece);
        while (const auto message = decoder.next(part)) {
            demand(count < expected.size());
            const Lines& lines = expected[count++];
            demand(message->damage.has_value() == damaged(lines));
            if (!message->damage) demand(on_the_wire(*message) == lines);
            demand_same_scan(*message);
            demand_usable(*message);
        }
        demand(part.empty());
    }
    demand(count == expected.size());
}

/// Hands the bytes over one piece after the other, whatever is asked for.
class Recording : public Transport {
  public:
    Recording(std::string_view bytes, std::size_t piece) : bytes_(bytes), piece_(piece) {}

    void write(std::string_view) override {}
    std::size_t read(std::span<char> buffer, std::chrono::milliseconds) override {
        const std::size_t count = std::min({bytes_.size(), buffer.size(), piece_});
        std::copy_n(bytes_.begin(), count, buffer.begin());
        bytes_.remove_prefix(count);
        return count;
    }

  private:
    std::string_view bytes_;
    std::size_t piece_;
};

void converse(std::string_view bytes, std::size_t piece) {
    Recording recording(bytes, piece);
    Driver driver(recording);
    const ScanRequest request{.first_step = 0, .last_step = 5};
    const std::vector<std::function<void()>> questions = {
        [&] { driver.connect(); },
        [&] { (void)driver.version(); },
        [&] { (void)driver.parameters(); },
        [&] { (void)driver.state(); },
        [&] { driver.switch_laser_on(); },
        [&] { (void)driver.single_scan(request); },
        [&] { driver.start(request); },
        [&] { (void)driver.next_scan(); },
        [&] { (void)driver.next_scan(); },
        [&] { driver.stop(); },
        [&] { driver.enter_adjust(); },
        [&] { (void)driver.time_ms(); },
        [&] { (void)driver.time_us(); },
        [&] { driver.leave_adjust(); },
        [&] { driver.reset(); },
    };
    for (const auto& ask : questions) {
        try {
            ask();
        } catch (const Error& error) {
            demand(!std::string_view(error.what()).empty());
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t piece = 1 + (data[0] & 0x7FU);
    const std::string_view sent(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::string bytes = (data[0] & 0x80U) != 0 ? with_sums(sent) : std::string(sent);
    decode_in_pieces(bytes, piece);
    converse(bytes, piece);
    return 0;
}
