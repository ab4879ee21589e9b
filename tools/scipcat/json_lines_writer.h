// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

#include "tools/scipcat/scan_writer.h"

namespace scipd::tools {

/// One object a scan, each complete in itself.
class JsonLinesFormat final : public ScanFormat {
  public:
    [[nodiscard]] std::string head(const RecordedScanner& scanner) const override;
    [[nodiscard]] std::string line(const RecordedScanner& scanner,
                                   const protocol::client::ScanMessage& scan,
                                   HostTime received) const override;
};

}  // namespace scipd::tools
