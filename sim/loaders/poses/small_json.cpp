// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The library calls the reader below for each value. It can stop at any of them, and no exception
// is thrown: one costs as much as reading ten lines, and a sender may send nothing but bad ones.
#include "sim/loaders/poses/small_json.h"

#include <string>
#include <utility>
#include <vector>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t deepest_json = 8;

/// The library's own words, without its name and number in brackets.
std::string words_of(const nlohmann::detail::exception& error) {
    const std::string_view text = error.what();
    const auto bracket = text.find("] ");
    return printable(bracket == text.npos ? text : text.substr(bracket + 2));
}

/// Builds the document. Each function returns whether to read on.
template <class Json>
class SmallJsonReader : public nlohmann::json_sax<Json> {
  public:
    SmallJsonReader(int most_values, bool each_key_once)
        : most_values_(most_values), each_key_once_(each_key_once) {}

    using typename nlohmann::json_sax<Json>::number_integer_t;
    using typename nlohmann::json_sax<Json>::number_unsigned_t;
    using typename nlohmann::json_sax<Json>::number_float_t;
    using typename nlohmann::json_sax<Json>::string_t;
    using typename nlohmann::json_sax<Json>::binary_t;

    bool null() override { return take(nullptr); }
    bool boolean(bool value) override { return take(value); }
    bool number_integer(number_integer_t value) override { return take(value); }
    bool number_unsigned(number_unsigned_t value) override { return take(value); }
    bool number_float(number_float_t value, const string_t&) override { return take(value); }
    bool string(string_t& value) override { return take(std::move(value)); }
    bool binary(binary_t& value) override { return take(std::move(value)); }

    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        if (!fits()) return false;
        if (each_key_once_ && open_.back()->contains(name)) {
            fault_ = {name, "is given twice"};
            return false;
        }
        member_ = &(*open_.back())[name];
        return true;
    }

    bool parse_error(std::size_t, const std::string&,
                     const nlohmann::detail::exception& error) override {
        fault_.why = "not JSON: " + words_of(error);
        return false;
    }

    [[nodiscard]] Json& document() { return document_; }
    /// Once it has stopped early.
    [[nodiscard]] const Fault& fault() const { return fault_; }

  private:
    bool fits() {
        if (open_.size() > deepest_json)
            fault_.why = "nests deeper than " + std::to_string(deepest_json) + " levels";
        else if (++values_ > most_values_)
            fault_.why = "has more than " + std::to_string(most_values_) + " keys and values";
        return fault_.why.empty();
    }

    bool take(Json&& value) {
        if (!fits()) return false;
        put(std::move(value));
        return true;
    }

    bool open(Json&& list) {
        if (!fits()) return false;
        open_.push_back(&put(std::move(list)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return fits();
    }

    Json& put(Json&& value) {
        if (open_.empty()) return document_ = std::move(value);
        if (open_.back()->is_object()) return *member_ = std::move(value);
        return open_.back()->emplace_back(std::move(value));
    }

    int most_values_;
    bool each_key_once_;
    int values_ = 0;
    Json document_;
    std::vector<Json*> open_;  ///< objects and arrays that have not ended, each within the last
    Json* member_ = nullptr;   ///< of the innermost object: the next value is for it
    Fault fault_;
};

template <class Json>
Expected<Json> parse(std::string_view text, int most_values, bool each_key_once) {
    SmallJsonReader<Json> reader(most_values, each_key_once);
    if (!Json::sax_parse(text, &reader)) return tl::unexpected(reader.fault());
    return std::move(reader.document());
}

}  // namespace

Expected<nlohmann::json> parse_small_json(std::string_view text, int most_values) {
    return parse<nlohmann::json>(text, most_values, false);
}

Expected<nlohmann::ordered_json> parse_ordered_json(std::string_view text, int most_values) {
    return parse<nlohmann::ordered_json>(text, most_values, true);
}

}  // namespace scipd::sim
