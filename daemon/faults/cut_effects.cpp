// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A line that is cut, and a tty that hangs up.
#include <string>
#include <string_view>
#include <utility>

#include "daemon/config/values.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"
#include "daemon/link/port.h"

namespace scipd::daemon {
namespace {

enum class CutKind {
    fin,
    rst,
    silent,  ///< as if the cable were out: neither end is told
    refuse,  ///< who is connected stays
    mute,    ///< who connects is accepted, and not answered
};

constexpr std::pair<std::string_view, CutKind> cut_words[] = {{"fin", CutKind::fin},
                                                              {"rst", CutKind::rst},
                                                              {"silent", CutKind::silent},
                                                              {"refuse", CutKind::refuse},
                                                              {"mute", CutKind::mute}};

std::size_t cut_off(FaultScene& scene, Cut how) {
    std::size_t clients = 0;
    for (Port* const port : scene.ports()) {
        if (port->connected()) ++clients;
        port->cut(how);
    }
    return clients;
}

/// Its cable carries power.
void boot_device(FaultScene& scene) {
    scene.touched({.what = "the device boots"});
    scene.boot();
}

class CutLine final : public FaultEffect {
  public:
    struct Members {
        CutKind how = CutKind::rst;
        bool boots = false;
    };
    static constexpr Member<Members> members[] = {
        {"how", read_as<&Members::how, parse_word<cut_words>>},
        {"boot", read_as<&Members::boots, parse_switch>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (fault.value["until"])
            return faults.add(fault, "needs for instead of until: no request comes in meanwhile");
        if (members.how == CutKind::fin || members.how == CutKind::rst) return;
        if (!fault.value["for"])
            faults.add(fault, "needs for: a cut that is silent, refuse or mute lasts");
    }

    explicit CutLine(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        if (!ends_connections()) return scene.touched({.what = said()});
        const std::size_t clients =
            cut_off(scene, members_.how == CutKind::fin ? Cut::fin : Cut::rst);
        scene.touched({.what = said() + ", clients cut off: " + std::to_string(clients)});
    }

    void end(FaultScene& scene) override {
        if (members_.how == CutKind::silent) {
            for (Port* const port : scene.ports()) {
                if (port->kind() == protocol::LinkKind::network) port->cut(Cut::rst);
            }
        }
        if (members_.boots) boot_device(scene);
    }

    void line(LineState& line) const override {
        if (ends_connections() || members_.how == CutKind::refuse) {
            line.refuses = true;
        } else {
            line.dead = true;
        }
    }

  private:
    [[nodiscard]] bool ends_connections() const {
        return members_.how == CutKind::fin || members_.how == CutKind::rst;
    }

    [[nodiscard]] std::string said() const {
        switch (members_.how) {
            case CutKind::fin:
                return "cut with FIN";
            case CutKind::rst:
                return "cut with RST";
            case CutKind::silent:
                return "cut silently";
            case CutKind::refuse:
                return "new clients are refused";
            case CutKind::mute:
                return "nobody is answered";
        }
        return {};
    }

    Members members_;
};

class HangUp final : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto members = no_members;
    static void check(const Members& /*members*/, const sim::YamlField& /*fault*/,
                      sim::YamlFaults& /*faults*/) {}

    explicit HangUp(const Members& /*members*/) {}

    void begin(FaultScene& scene) override {
        std::size_t ttys = 0;
        for (Port* const port : scene.ports()) {
            if (port->kind() != protocol::LinkKind::tty) continue;
            port->cut(Cut::rst);
            ++ttys;
        }
        scene.touched({.what = ttys > 0 ? "the tty hangs up" : "there is no tty to hang up"});
    }

    void line(LineState& line) const override { line.hung_up = true; }
};

constexpr FaultKind cut_rows[] = {
    kind_of<CutLine>("cut", "link", "the connection ends, falls silent or is refused", true),
    kind_of<HangUp>("hangup", "link", "the tty is unplugged"),
};

}  // namespace

std::span<const FaultKind> cut_kinds() {
    return cut_rows;
}

}  // namespace scipd::daemon
