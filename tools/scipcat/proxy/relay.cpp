// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/relay.h"

#include <charconv>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/line_reader.h"
#include "protocol/reply.h"
#include "protocol/speaker.h"
#include "tools/scipcat/proxy/far_end.h"
#include "tools/scipcat/proxy/proxy_faults.h"

namespace scipd::tools {
namespace {

using protocol::Send;

/// SS019200 and whatever follows, S0192000000000; 0: no such request.
int rate_in(std::string_view request) {
    constexpr std::size_t rate_digits = 6;
    constexpr std::size_t scip1_length = 14;
    const bool scip2 = request.starts_with("SS");
    if (!scip2 && !(request.starts_with("S") && request.size() == scip1_length)) return 0;
    const std::string_view digits = request.substr(scip2 ? 2 : 1, rate_digits);
    int rate = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rate);
    return digits.size() == rate_digits && stop == digits.data() + rate_digits ? rate : 0;
}

/// 00 and its sum, or 0 of SCIP 1.1. What a scanner refuses, or has already, changes nothing.
bool agrees(std::string_view status) {
    return status == "0" || (status.size() == 3 && status.starts_with("00"));
}

// A scanner that is asked for more than it reads holds the driver up, as without a proxy.
constexpr std::size_t most_requests_bytes = 64 * 1024;
// So does a driver that reads too slowly the scanner.
constexpr std::size_t most_answers_bytes = 256 * 1024;
// What does not end by then is no message.
constexpr std::size_t longest_message = 128 * 1024;
// So long may a scanner answer to a driver that has ended its side, and not its own.
constexpr std::chrono::seconds last_answers{1};

/// A scan of a stream has the status 99, under its echo.
Send::Kind kind_of(std::string_view message) {
    const std::size_t line = message.find('\n');
    const bool scan = line != std::string_view::npos && message.substr(line + 1, 2) == "99";
    return scan ? Send::Kind::scan : Send::Kind::reply;
}

}  // namespace

/// Hears on a serial line that a driver has a scanner change the rate: SS of SCIP 2.0, S of 1.1.
/// Once the scanner has agreed, in full, it goes on at the other rate.
class RateChange {
  public:
    void asks(std::string_view bytes);
    /// The rate that holds behind these bytes, in bits per second; nothing: as before.
    [[nodiscard]] std::optional<int> answers(std::string_view bytes);
    /// Another driver is there.
    void forget() { *this = {}; }

  private:
    /// A line of the scanner, without its end.
    [[nodiscard]] std::optional<int> take(const std::string& line);

    protocol::LineReader reader_;
    std::string line_;     ///< what has come of one of the scanner's
    std::string request_;  ///< the latest that asks for a rate; empty: none
    int rate_ = 0;         ///< in it
    enum class Next { echo, status, end } next_ = Next::echo;
};

void RateChange::asks(std::string_view bytes) {
    while (const auto line = reader_.next(bytes)) {
        if (const int rate = rate_in(line->text); rate > 0) {
            request_ = line->text;
            rate_ = rate;
        }
    }
}

std::optional<int> RateChange::answers(std::string_view bytes) {
    std::optional<int> rate;
    for (const char c : bytes) {
        if (c != '\n') {
            if (!request_.empty() && line_.size() <= protocol::LineReader::max_length) line_ += c;
            continue;
        }
        if (const auto agreed = take(line_)) rate = agreed;
        line_.clear();
    }
    return rate;
}

std::optional<int> RateChange::take(const std::string& line) {
    if (request_.empty()) return std::nullopt;
    switch (next_) {
        case Next::echo:
            if (line == request_) next_ = Next::status;
            return std::nullopt;
        case Next::status:
            next_ = agrees(line) ? Next::end : Next::echo;
            if (next_ == Next::echo) request_.clear();
            return std::nullopt;
        case Next::end:
            break;
    }
    next_ = Next::echo;
    request_.clear();
    return rate_;
}

/// One driver and its connection to the scanner. A tty has one for all who open it, one after the
/// other.
class Relay::Driver final : public daemon::Endpoint::Client, private protocol::Speaker {
  public:
    Driver(Relay& relay, std::function<void()> on_actions, protocol::LinkKind link);
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;
    ~Driver() override;

    /// A driver is there.
    void open();

  private:
    // Endpoint::Client
    [[nodiscard]] protocol::Speaker& session() override { return *this; }
    void receive(std::string_view bytes) override;
    [[nodiscard]] std::optional<sim::Time> wake_at() const override { return ends_at_; }
    void wake() override;

    // Speaker
    [[nodiscard]] bool full() const override;
    [[nodiscard]] bool streaming() const override { return false; }
    [[nodiscard]] bool owes() const override { return ends_at_.has_value(); }
    [[nodiscard]] std::optional<protocol::Action> next_action() override;
    [[nodiscard]] bool patient() const override { return true; }
    [[nodiscard]] bool ended() const override { return lost_ && actions_.empty(); }
    void end_of_input() override;
    void close() override;
    void forget() override { close(); }

    void pass_on(std::string_view bytes);
    void receive_by_lines(std::string_view bytes);
    void hear(std::string_view bytes);
    void say_messages(std::string_view bytes);
    void say(protocol::Send message);
    void lose(const std::string& why);
    /// The scanner may have agreed to another rate of its serial line.
    void follow_rate(std::string_view bytes);

    Relay& relay_;
    std::function<void()> on_actions_;
    protocol::LinkKind link_;
    std::shared_ptr<FarEnd> scanner_;  ///< null: no driver, or the scanner is gone
    bool lost_ = false;
    std::optional<sim::Time> ends_at_;  ///< the driver has ended its side
    RateChange rate_;
    std::deque<protocol::Send> actions_;
    std::size_t bytes_ = 0;  ///< of them
    // While faults may act.
    protocol::LineReader reader_;
    std::string line_;     ///< what has come of a request
    std::string message_;  ///< what has come of an answer
};

Relay::Driver::Driver(Relay& relay, std::function<void()> on_actions, protocol::LinkKind link)
    : relay_(relay), on_actions_(std::move(on_actions)), link_(link) {
    relay_.driver_ = this;
}

Relay::Driver::~Driver() {
    close();
    if (relay_.driver_ == this) relay_.driver_ = nullptr;
}

void Relay::Driver::open() {
    close();
    scanner_ = std::make_shared<FarEnd>(
        relay_.executor_, FarEnd::Hooks{.opened = [this] { relay_.hooks_.opened(); },
                                        .heard = [this](std::string_view bytes) { hear(bytes); },
                                        .drained = [this] { on_actions_(); },
                                        .lost = [this](const std::string& why) { lose(why); }});
    scanner_->open(relay_.target_, relay_.options_);
}

void Relay::Driver::close() {
    if (scanner_) std::exchange(scanner_, nullptr)->close();
    lost_ = false;
    ends_at_.reset();
    actions_.clear();
    bytes_ = 0;
    reader_.forget();
    line_.clear();
    message_.clear();
    rate_.forget();
    if (relay_.faults_ != nullptr) relay_.faults_->forget(*this);
}

void Relay::Driver::receive(std::string_view bytes) {
    if (!scanner_) return;
    const bool by_lines = relay_.faults_ != nullptr && relay_.faults_->any();
    if (by_lines) return receive_by_lines(bytes);
    if (!line_.empty()) pass_on(std::exchange(line_, {}));
    pass_on(bytes);
}

void Relay::Driver::pass_on(std::string_view bytes) {
    scanner_->write(bytes);
    rate_.asks(bytes);
    relay_.hooks_.heard(true, bytes);
}

void Relay::Driver::receive_by_lines(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::string_view before = bytes;
        const auto line = reader_.next(bytes);
        line_ += before.substr(0, before.size() - bytes.size());
        if (!line) return;
        const std::string raw = std::exchange(line_, {});
        const auto status = relay_.faults_->refuse({.echo = line->text});
        if (!status) {
            pass_on(raw);
        } else {
            say({protocol::Reply(line->text, *status).finish(), Send::Kind::reply});
        }
    }
}

// A driver changes its own end when it has read the answer, and waits a little before it says more.
void Relay::Driver::follow_rate(std::string_view bytes) {
    const auto rate = rate_.answers(bytes);
    if (!rate || !scanner_) return;
    relay_.hooks_.rate(*rate, scanner_->set_rate(*rate));
}

void Relay::Driver::hear(std::string_view bytes) {
    follow_rate(bytes);
    if (relay_.faults_ != nullptr && relay_.faults_->any()) {
        say_messages(bytes);
    } else {
        if (!message_.empty()) say({std::exchange(message_, {}), Send::Kind::reply});
        actions_.push_back({std::string(bytes), Send::Kind::reply});
        bytes_ += bytes.size();
    }
    if (scanner_ && bytes_ > most_answers_bytes) scanner_->pause();
    on_actions_();
    relay_.hooks_.heard(false, bytes);
}

void Relay::Driver::say_messages(std::string_view bytes) {
    message_ += bytes;
    for (std::size_t end = message_.find("\n\n"); end != std::string::npos;
         end = message_.find("\n\n")) {
        std::string one = message_.substr(0, end + 2);
        message_.erase(0, end + 2);
        const Send::Kind kind = kind_of(one);
        say({std::move(one), kind});
        // The next one may be where a fault of the line begins.
        on_actions_();
    }
    if (message_.size() > longest_message) say({std::exchange(message_, {}), Send::Kind::reply});
}

void Relay::Driver::say(Send message) {
    for (Send& part : relay_.faults_->leave(*this, std::move(message))) {
        bytes_ += part.bytes.size();
        actions_.push_back(std::move(part));
    }
}

std::optional<protocol::Action> Relay::Driver::next_action() {
    if (actions_.empty()) return std::nullopt;
    Send next = std::move(actions_.front());
    actions_.pop_front();
    bytes_ -= next.bytes.size();
    if (scanner_ && bytes_ <= most_answers_bytes / 2) scanner_->resume();
    return next;
}

bool Relay::Driver::full() const {
    return scanner_ && scanner_->unwritten() > most_requests_bytes;
}

void Relay::Driver::end_of_input() {
    if (!scanner_) return;
    scanner_->end_writing();
    ends_at_ = relay_.clock_.now() + last_answers;
}

void Relay::Driver::wake() {
    if (ends_at_ && *ends_at_ <= relay_.clock_.now()) ends_at_.reset();
}

// A connection ends as soon as all has been said. A tty has no such end: it is unplugged.
void Relay::Driver::lose(const std::string& why) {
    scanner_ = nullptr;
    lost_ = link_ == protocol::LinkKind::network;
    const bool expected = std::exchange(ends_at_, std::nullopt).has_value();
    if (!expected) relay_.hooks_.lost(why);
    on_actions_();
}

Relay::Relay(boost::asio::any_io_executor executor, Target target, OpenOptions options,
             daemon::Clock& clock, Hooks hooks)
    : executor_(std::move(executor)),
      target_(std::move(target)),
      options_(options),
      clock_(clock),
      hooks_(std::move(hooks)) {}

std::unique_ptr<daemon::Endpoint::Client> Relay::connect(std::function<void()> on_actions,
                                                         protocol::LinkKind link) {
    return std::make_unique<Driver>(*this, std::move(on_actions), link);
}

void Relay::open() {
    if (driver_ != nullptr) driver_->open();
}

}  // namespace scipd::tools
