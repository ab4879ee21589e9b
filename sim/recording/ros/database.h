// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file of SQLite that is only read, and may be hostile: it runs nothing of its own, and no row
// takes long. Of one owner; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/expected.h"
#include "sim/recording/file/input_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace scipd::sim {

/// The rows of a question.
class Rows {
  public:
    Rows(sqlite3* database, const std::string& question);

    /// Goes on to the next row; false: there is none. The fault is the library's own words.
    [[nodiscard]] Expected<bool> next();

    [[nodiscard]] std::int64_t number(int column) const;
    /// Until next() is called.
    [[nodiscard]] std::string_view bytes(int column) const;

  private:
    struct Close {
        void operator()(sqlite3_stmt* statement) const;
    };

    sqlite3* database_;
    std::unique_ptr<sqlite3_stmt, Close> statement_;
};

class Database {
  public:
    [[nodiscard]] static Expected<Database> open(InputFile& file);

    [[nodiscard]] Rows ask(const std::string& question) { return {database_.get(), question}; }

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };

    std::unique_ptr<std::string> bytes_;  ///< of a file in memory
    std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace scipd::sim
