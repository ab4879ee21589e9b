// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/small_json.h"

#include <stdexcept>
#include <string>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using Json = nlohmann::json;

constexpr int deepest_json = 8;

/// Thrown through the library's parser, which cannot be stopped otherwise.
struct TooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The library's own words, without its name and number in brackets.
std::string words_of(const Json::exception& error) {
    const std::string_view text = error.what();
    const auto bracket = text.find("] ");
    return printable(bracket == text.npos ? text : text.substr(bracket + 2));
}

}  // namespace

Expected<Json> parse_small_json(std::string_view text, int most_values) {
    int values = 0;
    const auto count = [&values, most_values](int depth, Json::parse_event_t, const Json&) {
        if (depth > deepest_json) {
            throw TooLarge("nests deeper than " + std::to_string(deepest_json) + " levels");
        }
        if (++values > most_values) {
            throw TooLarge("has more than " + std::to_string(most_values) + " keys and values");
        }
        return true;
    };
    try {
        return Json::parse(text, count);
    } catch (const TooLarge& error) {
        return refuse(error.what());
    } catch (const Json::exception& error) {
        return refuse("not JSON: " + words_of(error));
    }
}

}  // namespace scipd::sim
