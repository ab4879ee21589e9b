// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Talks to a running scipd: HTTP/1.1 with JSON over its Unix socket, with one connection for all
// requests. Each call waits for its answer. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace scipd::tools {

/// scipd refused a request, or cannot be reached (status 0). what() is a sentence.
class ControlError : public std::runtime_error {
  public:
    ControlError(int status, const std::string& sentence)
        : std::runtime_error(sentence), status_(status) {}

    [[nodiscard]] int status() const { return status_; }

  private:
    int status_;
};

class ControlClient {
  public:
    using Json = nlohmann::ordered_json;

    /// Connects when the first request is made.
    explicit ControlClient(std::filesystem::path socket);
    ~ControlClient();

    /// All throw ControlError.
    [[nodiscard]] Json get(const std::string& path);
    /// The answer as it came.
    [[nodiscard]] std::string text(const std::string& path);
    void put(const std::string& path, const Json& body);

    // Changes that may take scipd long, such as loading a world. They return when scipd is done.
    // They return its answer, or null if it has no body.
    Json load(const std::string& path, const Json& body);
    Json post(const std::string& path, const Json& body);
    Json patch(const std::string& path, const Json& body);
    void remove(const std::string& path);
    /// Any request, with the answer as it came. It may take long, unless the method is GET.
    [[nodiscard]] std::string ask(const std::string& method, const std::string& path,
                                  const std::string& body);

  private:
    struct Connection;

    struct Question;

    std::string exchange(const Question& question);
    [[nodiscard]] ControlError unreachable(const std::string& why) const;

    std::filesystem::path socket_;
    std::unique_ptr<Connection> connection_;  ///< null: not connected yet, or no longer
};

/// For programs: plain ASCII, which a terminal prints unchanged.
[[nodiscard]] std::string json_text(const ControlClient::Json& document, int indent = -1);

/// A part of a path, with all characters escaped but letters, digits and -._~.
[[nodiscard]] std::string path_segment(const std::string& text);

}  // namespace scipd::tools
