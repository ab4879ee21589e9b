// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A bus of another program as a feed: what it says is handed over from its threads, understood, and
// taken in. In lockstep a message is one step of time.
#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/bridges/bus.h"
#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/handover.h"
#include "daemon/poses/heard_meaning.h"
#include "daemon/poses/pose_feed.h"

namespace scipd::daemon {
namespace {

// A turn of the event loop takes a fraction of a millisecond with these.
constexpr std::size_t poses_in_one_go = 256;
// Names that are missing are told once they had the time to come.
constexpr auto look_every = std::chrono::seconds(3);

class BusFeed : public PoseFeed, public std::enable_shared_from_this<BusFeed> {
  public:
    BusFeed(FeedContext context, PoseSource source, std::unique_ptr<HeardMeaning> meaning,
            const OpenBus& open)
        : context_(std::move(context)),
          source_(std::move(source)),
          meaning_(std::move(meaning)),
          handover_(context_.executor, context_.lockstep != nullptr),
          look_(context_.executor),
          bus_(open(handover_)) {}
    ~BusFeed() override { handover_.close(); }

    void stop() override {
        handover_.close();
        bus_.reset();
        look_.cancel();
        if (context_.lockstep != nullptr) context_.lockstep->remove(&sender_);
    }

    void move_models(bool yes) override { meaning_->move_models(yes); }

    [[nodiscard]] SourceReport report() const override {
        SourceReport report{.robot = robot(), .source = text_of(source_), .type = type_};
        arrivals_.tell(std::chrono::steady_clock::now(), report);
        report.lost = handover_.lost();
        report.troubles = troubles();
        return report;
    }

  private:
    void begin() override {
        if (context_.lockstep != nullptr) context_.lockstep->add(&sender_);
        handover_.open([weak = weak_from_this()] {
            if (const auto feed = weak.lock()) feed->work();
        });
        look_again();
    }

    void work() {
        const auto items = handover_.take(context_.lockstep != nullptr ? 0 : poses_in_one_go);
        for (const Handover::Item& item : items)
            std::visit([this](const auto& what) { take(what); }, item);
        if (items.empty()) return;
        const auto go_on = [weak = weak_from_this()] {
            if (const auto feed = weak.lock()) feed->work();
        };
        if (context_.lockstep != nullptr) {
            context_.lockstep->when_caught_up(go_on);
        } else {
            boost::asio::post(context_.executor, go_on);
        }
    }

    void take(const Heard& message) {
        const bool is_news = !message.for_good && !message.clock;
        if (is_news) type_ = message.type;
        const auto said = meaning_->take(message, robot(), context_.intake.world());
        if (context_.lockstep != nullptr) {
            step(message, said);
        } else {
            for (const sim::PoseLine& line : said.lines)
                place(line);
        }
        if (!is_news) return;
        const auto now = std::chrono::steady_clock::now();
        arrivals_.note(now, sender_.last_lateness());
        if (context_.lockstep == nullptr) arrivals_.log(now, robot(), needs());
    }

    void take(const Handover::Refusal& refusal) {
        arrivals_.note_refused();
        tell(refusal.why);
    }

    void take(const Handover::Trouble& trouble) {
        trouble_ = trouble.what;
        look();
    }

    void place(const sim::PoseLine& line) {
        if (!context_.intake.admit(rate_)) return;
        count(context_.intake.take(line, {}, sender_, context_.clock.now()));
    }

    /// Where poses say no time, the clock of the bus leads it.
    void step(const Heard& message, const HeardMeaning::Said& said) {
        if (message.clock) clock_ = message.clock;
        if (!said.until && !said.lines.empty()) clock_leads_ = true;
        if (message.clock ? !clock_leads_ : !said.until && said.lines.empty()) return;
        const auto until = said.until ? said.until : clock_;
        if (!until) return tell("it has no stamp, and time is that of the poses");
        const auto time = context_.intake.take_step(*until, sender_);
        if (!time) return tell(time.error().why);
        for (sim::PoseLine line : said.lines) {
            const sim::Time before = *until - line.time.value_or(*until);
            line.time = *until;
            count(context_.intake.take_at(*time - before, line, {}));
        }
        context_.lockstep->come_to(&sender_, *time, true);
    }

    void count(const sim::Expected<>& taken) {
        if (taken) return;
        arrivals_.note_refused();
        tell(taken.error().why);
    }

    void tell(const std::string& refusal) {
        const auto others = throttle_.admit(std::chrono::steady_clock::now());
        if (others) context_.report("pose of " + robot() + " refused: " + refusal + *others);
    }

    [[nodiscard]] std::vector<std::string> troubles() const {
        auto troubles = meaning_->troubles(robot(), context_.intake.world());
        if (!trouble_.empty()) troubles.insert(troubles.begin(), trouble_);
        return troubles;
    }

    void look_again() {
        look_.expires_after(look_every);
        look_.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
            const auto feed = weak.lock();
            if (error || !feed) return;
            feed->look();
            feed->look_again();
        });
    }

    /// Tells what is not there, once.
    void look() {
        auto now = troubles();
        for (const std::string& trouble : now) {
            if (std::ranges::find(told_, trouble) == told_.end())
                context_.report("poses of " + robot() + " from " + text_of(source_) + ": " +
                                trouble);
        }
        told_ = std::move(now);
    }

    FeedContext context_;
    PoseSource source_;
    std::unique_ptr<HeardMeaning> meaning_;
    SenderClock sender_;
    Rate rate_;
    Throttle throttle_;
    Arrivals arrivals_;
    std::optional<std::string> type_;
    std::string trouble_;
    std::vector<std::string> told_;
    std::optional<sim::Time> clock_;
    bool clock_leads_ = false;  ///< poses do not say their times themselves
    Handover handover_;
    boost::asio::steady_timer look_;
    std::unique_ptr<Bus> bus_;  ///< the last: it calls handover_ until it is gone
};

RosTopics topics_of(const PoseSource& source, bool in_lockstep) {
    RosTopics topics{.topic = source.topic};
    // Frames are often fixed to each other, which is said apart.
    if (source.topic.ends_with("/tf"))
        topics.fixed = source.topic + "_static";
    else if (source.frames != RosFrames{})
        topics.fixed = "/tf_static";
    if (in_lockstep) topics.clock = "/clock";
    return topics;
}

}  // namespace

std::shared_ptr<PoseFeed> make_bus_feed(const FeedContext& context, const PoseSource& source) {
    if (source.kind == PoseSource::Kind::gz) {
        std::vector<std::string> topics{source.topic};
        if (context.lockstep != nullptr) topics.emplace_back("/clock");
        return make_bus_feed(context, source, make_gz_meaning(source.called),
                             [&](BusListener& listener) { return listen_to_gz(topics, listener); });
    }
    const RosTopics topics = topics_of(source, context.lockstep != nullptr);
    return make_bus_feed(context, source, make_ros_meaning(source.frames),
                         [&](BusListener& listener) {
                             const Address& at = source.address;
                             return source.kind == PoseSource::Kind::ros2
                                        ? listen_to_ros2(topics, listener)
                                        : listen_to_rosbridge(at.host, at.port, topics, listener);
                         });
}

std::shared_ptr<PoseFeed> make_bus_feed(const FeedContext& context, const PoseSource& source,
                                        std::unique_ptr<HeardMeaning> meaning,
                                        const OpenBus& open) {
    return std::make_shared<BusFeed>(context, source, std::move(meaning), open);
}

}  // namespace scipd::daemon
