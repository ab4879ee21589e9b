// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/protocol/dialogue.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <stdexcept>
#include <utility>

namespace scipd::protocol {
namespace {

std::string hexadecimal_value(const std::string& text, std::size_t& at) {
    int value = 0;
    const char* const begin = text.data() + at + 1;
    const auto [end, error] =
        std::from_chars(begin, std::min(begin + 2, text.data() + text.size()), value, 16);
    if (error != std::errc{} || end != begin + 2)
        throw std::invalid_argument("\\x wants two hexadecimal digits");
    at += 2;
    return {static_cast<char>(value)};
}

std::string unescaped(const std::string& text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            bytes += text[i];
            continue;
        }
        switch (++i < text.size() ? text[i] : '\0') {
            case 'n':
                bytes += '\n';
                break;
            case 'r':
                bytes += '\r';
                break;
            case '\\':
                bytes += '\\';
                break;
            case 'x':
                bytes += hexadecimal_value(text, i);
                break;
            default:
                throw std::invalid_argument("the escapes are \\n \\r \\\\ and \\xHH");
        }
    }
    return bytes;
}

class Parser {
  public:
    explicit Parser(Dialogue& dialogue) : dialogue_(dialogue) {}

    void parse(int number, const std::string& line) {
        number_ = number;
        if (line.starts_with("<")) return hear(line);
        if (line.starts_with(">> ")) return add(Say{unescaped(line.substr(3))});
        if (line.starts_with("> ")) return add(Say{unescaped(line.substr(2)) + "\n"});
        if (line == ">") return add(Say{"\n"});
        if (line == "hang up") return add(Hang{});
        if (line == "link drops") return add(Expect{DropLink{}});
        if (line.empty() || line.starts_with("#")) return;
        if (!time(line) && !sight(line) && !echoes(line) && !rate(line) && !io(line) &&
            !trouble(line) && !header(line))
            throw std::invalid_argument("not understood: " + line);
    }

  private:
    template <class What>
    void add(What what) {
        dialogue_.steps.push_back({number_, std::move(what)});
    }

    void hear(const std::string& line) {
        if (dialogue_.steps.empty() || !std::holds_alternative<Hear>(dialogue_.steps.back().what))
            add(Hear{});
        Hear& heard = std::get<Hear>(dialogue_.steps.back().what);
        if (line.starts_with("<\\ ")) {
            heard.bytes += unescaped(line.substr(3));
        } else if (line == "<" || line.starts_with("< ")) {
            heard.bytes += line.substr(std::min<std::size_t>(2, line.size()));
        } else {
            throw std::invalid_argument("a blank is missing after <");
        }
        heard.bytes += '\n';
        heard.lines.push_back(number_);
    }

    bool time(const std::string& line) {
        static const std::regex form(R"(at (\d+)(?:\.(\d{1,6}))? ms)");
        std::smatch match;
        if (!std::regex_match(line, match, form)) return false;
        const std::string fraction = (match[2].str() + "000000").substr(0, 6);
        add(Wait{std::chrono::milliseconds(std::stoll(match[1])) +
                 std::chrono::nanoseconds(std::stoll(fraction))});
        return true;
    }

    bool sight(const std::string& line) {
        static const std::regex form(
            R"((distance|intensity)(?: (\d+)(?:\.\.(\d+))?)?: (\d+)(?: ([+-]) (\d+)\*step)?)");
        std::smatch match;
        if (!std::regex_match(line, match, form)) return false;
        Sight seen{.intensity = match[1] == "intensity", .last = std::numeric_limits<int>::max()};
        if (match[2].matched) seen.first = seen.last = std::stoi(match[2]);
        if (match[3].matched) seen.last = std::stoi(match[3]);
        seen.base = std::stoll(match[4]);
        if (match[6].matched) seen.slope = std::stoll(match[5].str() + match[6].str());
        add(seen);
        return true;
    }

    bool echoes(const std::string& line) {
        static const std::regex form(R"(echoes (\d+)(?:\.\.(\d+))?:((?: \d+/\d+){1,3}))");
        static const std::regex pair(R"((\d+)/(\d+))");
        std::smatch match;
        if (!std::regex_match(line, match, form)) return false;
        Echoes seen{.first = std::stoi(match[1]),
                    .last = std::stoi(match[match[2].matched ? 2 : 1])};
        const std::string pairs = match[3];
        seen.echoes.count = 0;
        for (std::sregex_iterator at(pairs.begin(), pairs.end(), pair), end; at != end; ++at) {
            seen.echoes.echo[seen.echoes.count++] = {
                static_cast<std::uint32_t>(std::stoul((*at)[1])),
                static_cast<std::uint32_t>(std::stoul((*at)[2]))};
        }
        add(seen);
        return true;
    }

    bool rate(const std::string& line) {
        static const std::regex form(R"(rate (\d+))");
        std::smatch match;
        if (!std::regex_match(line, match, form)) return false;
        add(Expect{SetBitRate{std::stoi(match[1])}});
        return true;
    }

    bool io(const std::string& line) {
        static const std::regex form(R"(io: (\d+) (\d+))");
        std::smatch match;
        if (!std::regex_match(line, match, form)) return false;
        add(IoWords{static_cast<std::uint32_t>(std::stoul(match[1])),
                    static_cast<std::uint32_t>(std::stoul(match[2]))});
        return true;
    }

    bool trouble(const std::string& line) {
        static const std::map<std::string, Trouble> named = {
            {"trouble: none", Trouble::none},
            {"trouble: unstable", Trouble::unstable},
            {"trouble: laser", Trouble::laser},
            {"trouble: abnormal", Trouble::abnormal},
        };
        const auto found = named.find(line);
        if (found == named.end()) return false;
        add(Suffer{found->second});
        return true;
    }

    bool header(const std::string& line) {
        static const std::regex clock(R"(clock: (\d+) ms)");
        std::smatch match;
        if (!dialogue_.steps.empty()) return false;
        if (line.starts_with("model: ")) {
            dialogue_.model = line.substr(7);
        } else if (line == "timing: ideal" || line == "timing: real") {
            dialogue_.ideal = line.ends_with("ideal");
        } else if (line == "with: io_lines") {
            dialogue_.io_lines = true;
        } else if (line == "power-up: boot") {
            dialogue_.boot = true;
        } else if (std::regex_match(line, match, clock)) {
            dialogue_.clock = std::chrono::milliseconds(std::stoll(match[1]));
        } else if (line == "power-up: scip1.1") {
            dialogue_.scip1 = true;
        } else {
            return false;
        }
        return true;
    }

    Dialogue& dialogue_;
    int number_ = 0;
};

}  // namespace

Dialogue parse_dialogue(const std::string& name, std::string_view text) {
    constexpr std::string_view citation = "# source: ";
    Dialogue dialogue;
    dialogue.name = name;
    Parser parser(dialogue);
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        try {
            if (++number == 1) {
                if (!line.starts_with(citation) || line.size() < citation.size() + 10)
                    throw std::invalid_argument(
                        "the first line must say where the bytes are known from, in 10 characters "
                        "or more: # source: …");
                dialogue.source = line.substr(citation.size());
            }
            parser.parse(number, line);
        } catch (const std::invalid_argument& fault) {
            throw std::invalid_argument(name + ":" + std::to_string(number) + ": " + fault.what());
        }
    }
    if (dialogue.source.empty()) throw std::invalid_argument(name + ":1: empty, cites no source");
    if (dialogue.model.empty()) throw std::invalid_argument(name + ": names no model");
    return dialogue;
}

Dialogue read_dialogue(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::invalid_argument(file.string() + ": cannot be read");
    return parse_dialogue(file.filename().string(),
                          std::string(std::istreambuf_iterator<char>(stream), {}));
}

}  // namespace scipd::protocol
