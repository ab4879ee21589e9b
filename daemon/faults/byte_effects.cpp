// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes that change, are lost or come twice on their way to the client, and noise between messages.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"
#include "daemon/faults/message_lines.h"
#include "daemon/link/port.h"

namespace scipd::daemon {
namespace {

using protocol::Send;

constexpr int largest_offset = 65'535;

sim::Expected<int> parse_offset(std::string_view text) {
    return parse_whole(text, 0, largest_offset);
}

/// Which bytes of a message: by chance, or those that stand there.
struct ByteChoice {
    std::optional<double> rate;
    std::optional<std::vector<int>> at;
};

constexpr Member<ByteChoice> byte_choice_members[] = {
    {"rate", read_as<&ByteChoice::rate, parse_share>},
    {"at", read_list<&ByteChoice::at, parse_offset>},
};

/// True: only sums.
constexpr std::pair<std::string_view, bool> within_words[] = {{"all", false}, {"sums", true}};
/// True: random.
constexpr std::pair<std::string_view, bool> noise_words[] = {{"nul", false}, {"random", true}};

std::string bytes_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " byte" : " bytes");
}

class ByteEffect : public FaultEffect {
  public:
    struct Members {
        ByteChoice bytes;
        MessageChoice messages = MessageChoice::all;
        bool only_sums = false;
    };
    static constexpr Member<Members> members[] = {
        {"bytes", read_map<&Members::bytes, byte_choice_members>},
        {"messages", read_as<&Members::messages, parse_word<message_choices>>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        const bool none = members.bytes.at && members.bytes.at->empty();
        if (members.bytes.rate.has_value() != members.bytes.at.has_value() && !none) return;
        faults.add(fault, "needs either bytes: {rate: 0..1} or bytes: {at: [offsets]}");
    }

    explicit ByteEffect(const Members& members) : members_(members) {
        if (members_.bytes.at) std::ranges::sort(*members_.bytes.at);
    }

    void bytes(Send& message, FaultScene& scene) final {
        if (!chooses(members_.messages, message)) return;
        std::vector<std::size_t> offsets = chosen(message.bytes, scene);
        if (offsets.empty()) return;
        change(message.bytes, offsets, scene);
        std::string what = bytes_text(offsets.size());
        scene.touched({.what = what.append(" ").append(done()), .bytes = std::move(offsets)});
    }

  protected:
    /// The offsets grow.
    virtual void change(std::string& bytes, std::span<const std::size_t> offsets,
                        const FaultScene& scene) const = 0;
    [[nodiscard]] virtual std::string_view done() const = 0;

    /// Each byte has two numbers of its own.
    enum class Draw : std::uint32_t { whether, which_bit };
    static double chance(const FaultScene& scene, std::size_t offset, Draw draw) {
        return scene.chance(2 * static_cast<std::uint32_t>(offset) +
                            static_cast<std::uint32_t>(draw));
    }

  private:
    [[nodiscard]] bool is_chosen(std::size_t offset, const FaultScene& scene) const {
        const ByteChoice& choice = members_.bytes;
        if (choice.at) return std::ranges::binary_search(*choice.at, static_cast<int>(offset));
        return chance(scene, offset, Draw::whether) < *choice.rate;
    }

    [[nodiscard]] std::vector<std::size_t> chosen(std::string_view message,
                                                  const FaultScene& scene) const {
        std::vector<std::size_t> offsets;
        const auto consider = [&](std::size_t offset) {
            if (is_chosen(offset, scene)) offsets.push_back(offset);
        };
        if (members_.only_sums) {
            std::ranges::for_each(places_of_sums(message, SumsOf::all), consider);
        } else {
            for (std::size_t i = 0; i < message.size(); ++i)
                consider(i);
        }
        return offsets;
    }

    Members members_;
};

/// One bit of each chosen byte is wrong.
class Corrupt final : public ByteEffect {
  public:
    static constexpr Member<Members> members[] = {
        ByteEffect::members[0],
        ByteEffect::members[1],
        {"within", read_as<&Members::only_sums, parse_word<within_words>>},
    };
    using ByteEffect::ByteEffect;

  private:
    void change(std::string& bytes, std::span<const std::size_t> offsets,
                const FaultScene& scene) const override {
        for (const std::size_t offset : offsets) {
            const auto bit = static_cast<unsigned>(8.0 * chance(scene, offset, Draw::which_bit));
            const auto byte = static_cast<unsigned char>(bytes[offset]);
            bytes[offset] = static_cast<char>(byte ^ (1U << std::min(bit, 7U)));
        }
    }
    [[nodiscard]] std::string_view done() const override { return "changed"; }
};

class Lose final : public ByteEffect {
  public:
    using ByteEffect::ByteEffect;

  private:
    void change(std::string& bytes, std::span<const std::size_t> offsets,
                const FaultScene& /*scene*/) const override {
        std::string rest;
        std::size_t from = 0;
        for (const std::size_t offset : offsets) {
            rest.append(bytes, from, offset - from);
            from = offset + 1;
        }
        bytes = rest.append(bytes, from);
    }
    [[nodiscard]] std::string_view done() const override { return "lost"; }
};

class Duplicate final : public ByteEffect {
  public:
    using ByteEffect::ByteEffect;

  private:
    void change(std::string& bytes, std::span<const std::size_t> offsets,
                const FaultScene& /*scene*/) const override {
        std::string all;
        std::size_t from = 0;
        for (const std::size_t offset : offsets) {
            all.append(bytes, from, offset + 1 - from);
            from = offset;
        }
        bytes = all.append(bytes, from);
    }
    [[nodiscard]] std::string_view done() const override { return "sent twice"; }
};

sim::Expected<int> parse_noise_count(std::string_view text) {
    constexpr int most = 4096;
    return parse_whole(text, 1, most);
}

/// As a line's driver makes where it is switched on.
class Noise final : public FaultEffect {
  public:
    struct Members {
        int count = 20;
        bool random = false;
    };
    static constexpr Member<Members> members[] = {
        {"count", read_as<&Members::count, parse_noise_count>},
        {"value", read_as<&Members::random, parse_word<noise_words>>},
    };
    static void check(const Members& /*members*/, const sim::YamlField& /*fault*/,
                      sim::YamlFaults& /*faults*/) {}

    explicit Noise(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override { send_to_all(scene); }
    void booted(FaultScene& scene) override { send_to_all(scene); }
    void connected(Port& port, FaultScene& scene) override {
        port.send_raw(noise(scene));
        scene.touched({.what = bytes_text(static_cast<std::size_t>(members_.count)) + " of noise"});
    }

  private:
    void send_to_all(FaultScene& scene) {
        for (Port* const port : scene.ports()) {
            if (port->connected()) connected(*port, scene);
        }
    }

    [[nodiscard]] std::string noise(const FaultScene& scene) const {
        constexpr double values = 256.0;
        std::string bytes(static_cast<std::size_t>(members_.count), '\0');
        if (!members_.random) return bytes;
        for (std::uint32_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<char>(static_cast<unsigned char>(values * scene.chance(i)));
        return bytes;
    }

    Members members_;
};

constexpr FaultKind byte_rows[] = {
    kind_of<Corrupt>("corrupt", "link", "a bit of some bytes is wrong"),
    kind_of<Lose>("lose", "link", "some bytes are lost"),
    kind_of<Duplicate>("duplicate", "link", "some bytes come twice"),
    kind_of<Noise>("noise", "link", "bytes without meaning at power-up and to who connects"),
};

}  // namespace

std::span<const FaultKind> byte_kinds() {
    return byte_rows;
}

}  // namespace scipd::daemon
