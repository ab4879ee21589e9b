// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A fixture for GoogleTest whose scipds end with their test. A test that fails keeps their logs,
// conversations and last scans, in a folder of its own in $SCIPD_KEEP, else in scipd-failed in the
// working directory. Needs GoogleTest, which the rest does without. One thread.
#pragma once

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <list>
#include <string>
#include <system_error>

#include <gtest/gtest.h>

#include "testing/scipd.h"

namespace scipd::testing {

class ScipdTest : public ::testing::Test {
  public:
    ~ScipdTest() override {
        for (Scipd& scipd : scipds_)
            close(scipd);
        if (HasFailure()) keep();
    }

  protected:
    ScipdTest() {
        std::error_code ignored;
        std::filesystem::remove_all(kept_folder(), ignored);  // of an earlier run
    }

    /// A scipd for this test; as many as you like. `last` is how much a failed test keeps of what
    /// the scanners saw. With 0 s scipd computes only those scans that a driver asks for.
    Scipd& start(const Options& options = {},
                 std::chrono::duration<double> last = std::chrono::seconds(5)) {
        Scipd& scipd = scipds_.emplace_back(options);
        if (last.count() > 0) scipd.keep_last(last);
        return scipd;
    }

  private:
    static std::filesystem::path kept_folder() {
        const char* const named = std::getenv("SCIPD_KEEP");
        const auto& test = *::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(test.test_suite_name()) + "." + test.name();
        for (char& c : name)
            c = c == '/' ? '-' : c;
        return std::filesystem::path(named == nullptr ? "scipd-failed" : named) / name;
    }

    static void close(Scipd& scipd) {
        try {
            scipd.close();
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }

    void keep() const try {
        int number = 0;
        for (const Scipd& scipd : scipds_) {
            const auto folder =
                scipds_.size() == 1 ? kept_folder() : kept_folder() / std::to_string(++number);
            scipd.save(folder);
            std::cerr << "log, wire and last scans of scipd are in " << absolute(folder) << "\n";
        }
    } catch (const std::exception& error) {
        std::cerr << "nothing is kept of scipd: " << error.what() << "\n";
    }

    std::list<Scipd> scipds_;
};

}  // namespace scipd::testing
