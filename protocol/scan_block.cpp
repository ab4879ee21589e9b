// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/scan_block.h"

#include <algorithm>
#include <string>

#include "protocol/char_code.h"
#include "protocol/timestamp.h"

namespace scipd::protocol {
namespace {

// As a value can begin with anything from '0' on, this tells that the step goes on.
constexpr char further_echo = '&';

StepEchoes echoes_at(const ScanView& scan, int step, const DeviceProfile& profile) {
    const int index = step - scan.first_step;
    if (index < 0 || index >= static_cast<int>(scan.distance.size()))
        return {.echo = {Echo{.distance = profile.codes.not_measured}}};
    if (!scan.echoes.empty()) return scan.echoes[index];
    return {.echo = {Echo{scan.distance[index], scan.intensity[index]}}};
}

// One set of echoes for each group of steps: that of its nearest. How real scanners group echoes is
// undocumented.
std::string echoes_in(const ScanView& scan, const StepWindow& window, DataFormat format,
                      const DeviceProfile& profile) {
    std::string characters;
    for (int first = window.first; first <= window.last; first += window.cluster) {
        const int last = std::min(first + window.cluster - 1, window.last);
        const StepEchoes step =
            echoes_at(scan, nearest_step(scan, first, last, true, profile), profile);
        for (int i = 0; i < step.count; ++i) {
            if (i > 0) characters.push_back(further_echo);
            append_encoded(characters, step.echo[i].distance, format.width);
            if (format.intensity) append_encoded(characters, step.echo[i].intensity, format.width);
        }
    }
    return characters;
}

std::string io_words(const IoWords& io) {
    constexpr int word_width = 3;
    std::string characters;
    append_encoded(characters, io.inputs, word_width);
    append_encoded(characters, io.outputs, word_width);
    return characters;
}

}  // namespace

void add_scan(Reply& reply, const ScanView& scan, const StepWindow& window, DataFormat format,
              const DeviceState& device, const DeviceProfile& profile) {
    if (format.io_lines) reply.line(io_words(device.io()));
    reply.line(format.stamp == Stamp::microseconds
                   ? encoded_microseconds(scan.turn.start, device.clock_zero())
                   : encoded_timestamp(scan.turn.start, device.clock_zero()));
    if (format.echoes) {
        reply.data(echoes_in(scan, window, format, profile));
    } else {
        reply.data(values_in(scan, window, format, profile), format.width);
    }
}

}  // namespace scipd::protocol
