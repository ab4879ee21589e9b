// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Configurations as texts, and the literal words of their faults.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {

class ConfigFixture : public testing::Test {
  protected:
    ConfigFixture() {
        dir_.write("room.sdf", "");
        dir_.write("walk.tum", "");
    }

    Config parse(const std::string& text) const {
        return parse_config(text, dir_.path() / "rig.yaml");
    }

    /// Without the folder, which differs from run to run.
    std::vector<std::string> faults(const std::string& text) const {
        try {
            parse(text);
        } catch (const sim::LoadError& error) {
            auto faults = error.faults();
            const std::string folder = dir_.path().string() + "/";
            for (auto& fault : faults) {
                for (auto at = fault.find(folder); at != fault.npos; at = fault.find(folder))
                    fault.erase(at, folder.size());
            }
            return faults;
        }
        return {};
    }

    /// A sensor that is whole, with this line besides.
    static std::string with(const std::string& line, const std::string& model = "UST-10LX") {
        return "scene: room.sdf\nrobots: {r: {sensors: {s: {pty: auto, model: " + model + ",\n" +
               line + "}}}}\n";
    }

    SensorConfig sensor(const std::string& line, const std::string& model = "UST-10LX") const {
        return parse(with(line, model)).robots.at(0).sensors.at(0);
    }

    std::vector<std::string> sensor_faults(const std::string& line,
                                           const std::string& model = "UST-10LX") const {
        return faults(with(line, model));
    }

    tests::TempDir dir_;
};

}  // namespace scipd::daemon
