// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/nearest_firmware.h"

#include <optional>

#include "daemon/models/model_registry.h"
#include "tools/scipcat/check/fingerprint.h"
#include "tools/scipcat/check/played_model.h"

namespace scipd::tools::checks {
namespace {

Fingerprint fingerprint_of(const protocol::DeviceProfile& profile, protocol::LinkKind link) {
    PlayedModel model(profile, link);
    return take_fingerprint([&](const std::string& request) { return model.ask(request); });
}

}  // namespace

NearestFirmware nearest_firmware(Subject& subject) {
    const auto link = subject.on_tty() ? protocol::LinkKind::tty : protocol::LinkKind::network;
    const Fingerprint asked =
        take_fingerprint([&](const std::string& request) -> std::optional<std::string> {
            const auto answer = subject.try_ask(request);
            return answer ? std::optional(answer->raw) : std::nullopt;
        });
    NearestFirmware nearest{.of = asked.size()};
    for (const daemon::Model& model : daemon::models()) {
        const std::size_t same = alike(asked, fingerprint_of(model.profile, link));
        if (nearest.model.empty() || same > nearest.alike) {
            nearest.model = model.profile.name + "@" + model.profile.release;
            nearest.alike = same;
        }
    }
    return nearest;
}

}  // namespace scipd::tools::checks
