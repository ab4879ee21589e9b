// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/measurement_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/api/object_text.h"
#include "daemon/config/values.h"
#include "sim/sensor/unit_bias.h"

namespace scipd::daemon {
namespace {

void add_poses(ObjectText& text, const Measurement& record) {
    const sim::Scan& scan = *record.cast;
    std::vector<std::size_t> fans;
    for (std::size_t i = 0; i < scan.world_from_sensor.size(); ++i) {
        if (i == 0 || scan.posed_at[i] != scan.posed_at[i - 1]) fans.push_back(i);
    }
    text.add_list("poses", fans, [&](std::string& list, std::size_t i) {
        append_timed_pose(list, seconds(record.told(scan.posed_at[i])), scan.world_from_sensor[i]);
    });
}

Json steps_of(const WireScan& sent) {
    Json steps = Json::array();
    for (std::size_t i = 0; i < sent.distance.size(); ++i)
        steps.push_back(sent.first_step + static_cast<int>(i));
    return steps;
}

Json reason_of(const BackendChoice& backend) {
    return backend.reason.empty() ? Json(nullptr) : Json(backend.reason);
}

/// The names of objects or materials as JSON, each made when it is first asked for.
template <class Thing>
class Names {
  public:
    explicit Names(const std::vector<Thing>& things) : things_(things), texts_(things.size()) {}

    const std::string& of(std::size_t id) {
        if (texts_[id].empty()) texts_[id] = text_of(things_[id].name);
        return texts_[id];
    }

  private:
    const std::vector<Thing>& things_;
    std::vector<std::string> texts_;
};

/// Adds a list with one element for each beam: of what its middle met.
template <class Append>
void add_hits(ObjectText& text, std::string_view name, const sim::Scan& scan, Append append) {
    text.add_list(name, scan.beams(), [&](std::string& list, std::size_t beam) {
        const sim::Hit& hit = scan.middle(beam);
        hit.met() ? append(list, hit) : void(list += "null");
    });
}

/// Adds the lists that every sensor's hits have.
void add_all_hits(ObjectText& text, const sim::Scan& cast, const sim::Scene& scene) {
    Names objects(scene.objects);
    Names materials(scene.materials);
    add_hits(text, "true_m", cast,
             [](std::string& list, const sim::Hit& hit) { append_rounded(list, hit.range_m); });
    add_hits(text, "object", cast,
             [&](std::string& list, const sim::Hit& hit) { list += objects.of(hit.object); });
    add_hits(text, "material", cast,
             [&](std::string& list, const sim::Hit& hit) { list += materials.of(hit.material); });
    add_hits(text, "incidence_rad", cast, [](std::string& list, const sim::Hit& hit) {
        append_rounded(list, std::acos(std::min(1.0F, hit.cos_incidence)));
    });
}

/// Appends a list within a list.
template <class Append>
void append_list(std::string& text, auto&& things, Append append) {
    char before = '[';
    for (const auto& thing : things) {
        text += std::exchange(before, ',');
        append(thing);
    }
    text += things.empty() ? "[]" : "]";
}

/// Adds a list for each beam of what came back to it.
void add_echoes(ObjectText& text, const sim::PerBeam<sim::Echo>& echoes, const sim::Scene& scene) {
    Names objects(scene.objects);
    Names materials(scene.materials);
    const auto append = [&](std::string& list, const sim::Echo& echo) {
        const bool in_the_air = echo.object == sim::no_object;
        append_rounded(list += R"({"range_m":)", echo.range_m);
        append_rounded(list += R"(,"power":)", echo.power);
        list.append(R"(,"object":)").append(in_the_air ? "null" : objects.of(echo.object));
        list.append(R"(,"material":)").append(in_the_air ? "null" : materials.of(echo.material));
        list += '}';
    };
    text.add_list("echoes", echoes.beams(), [&](std::string& list, std::size_t beam) {
        append_list(list, echoes[beam], [&](const sim::Echo& echo) { append(list, echo); });
    });
}

void add_sent_echoes(ObjectText& text, const std::vector<protocol::StepEchoes>& steps) {
    const auto add = [&](std::string_view name, auto value) {
        text.add_list(name, steps, [&](std::string& list, const auto& step) {
            const std::span told(step.echo.data(), static_cast<std::size_t>(step.count));
            append_list(list, told,
                        [&](const protocol::Echo& echo) { list += std::to_string(echo.*value); });
        });
    };
    add("sent_echoes_mm", &protocol::Echo::distance);
    add("sent_echoes_intensity", &protocol::Echo::intensity);
}

/// The range that became this reading, before any error: that of the echo with its light, or of the
/// hit where no light is seen.
float true_range_m(const sim::Scan& cast, std::size_t beam, const sim::Receiver& receiver) {
    const sim::Reading& reading = cast.readings[beam];
    if (reading.signal > 0.0F && beam < cast.echoes.beams()) {
        for (const sim::Echo& echo : cast.echoes[beam]) {
            if (sim::signal_of(receiver, echo.range_m, echo.power) == reading.signal)
                return echo.range_m;
        }
    }
    return cast.middle(beam).range_m;
}

/// Adds the range bias of the unit at the true range. Null where no range was read, and where the
/// beam met nothing: a fault or a recording may give such a beam a range.
void add_bias(ObjectText& text, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    text.add_list("bias_m", cast.readings.size(), [&](std::string& list, std::size_t beam) {
        sim::Reading unread = cast.readings[beam];
        unread.range_m = true_range_m(cast, beam, record.optics->receiver);
        const bool read = unread.cause == sim::Cause::measured && std::isfinite(unread.range_m);
        const double none = std::numeric_limits<double>::infinity();
        append_rounded(list, read ? sim::steady_error_m(*record.optics, unread) : none);
    });
}

/// Adds the stages between what the beams met and what was sent.
void add_stages(ObjectText& text, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    text.add("accuracy", name_of(record.accuracy));
    text.add_list("read_m", cast.readings, [](std::string& list, const sim::Reading& reading) {
        append_rounded(list, reading.range_m);
    });
    if (record.accuracy != sim::Accuracy::ideal) add_bias(text, record);
    text.add_list("cause", cast.readings, [](std::string& list, const sim::Reading& reading) {
        list.append(1, '"').append(cause_word(reading.cause)).append(1, '"');
    });
    if (!cast.echoes.empty()) add_echoes(text, cast.echoes, *record.scene);
    if (!record.sent.echoes.empty()) add_sent_echoes(text, record.sent.echoes);
}

/// Adds what depends on the kind of sensor.
void add_ranges(ObjectText& text, const StaringRecord& record) {
    const auto* const grid = std::get_if<sim::PinholeGrid>(&record.spec.optics);
    if (grid == nullptr) {
        const float range_m = record.range_m.front();
        return text.add("range_m", std::isfinite(range_m) ? Json(rounded(range_m)) : Json());
    }
    text.add("columns", grid->columns);
    text.add("rows", grid->rows);
    text.add_list("range_m", record.range_m, append_rounded);
}

Json middle_pose(const sim::Scan& scan) {
    const auto& poses = scan.world_from_sensor;
    return pose_document(poses[poses.size() / 2]);
}

}  // namespace

std::string_view cause_word(sim::Cause cause) {
    switch (cause) {
        case sim::Cause::measured:
            return "measured";
        case sim::Cause::nothing:
            return "nothing";
        case sim::Cause::too_dark:
            return "too_dark";
        case sim::Cause::too_bright:
            return "too_bright";
        case sim::Cause::edge:
            return "edge";
        case sim::Cause::interference:
            return "interference";
        case sim::Cause::lost:
            break;
    }
    return "lost";
}

std::string reading_text(const std::string& sensor, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    return text_of(Json{{"sensor", sensor},
                        {"scan", cast.revolution},
                        {"time_s", seconds(record.told(cast.start))},
                        {"stamp_ms", record.stamp_ms},
                        {"pose", middle_pose(cast)},
                        {"first_step", record.sent.first_step},
                        {"front_step", record.front_step},
                        {"steps_per_turn", record.steps_per_turn},
                        {"sent_mm", record.sent.distance},
                        {"intensity", record.sent.intensity}});
}

std::string reading_text(const std::string& sensor, const StaringRecord& record) {
    ObjectText text({{"sensor", sensor},
                     {"scan", record.cast->revolution},
                     {"time_s", seconds(record.told(record.cast->start))},
                     {"pose", middle_pose(*record.cast)}});
    add_ranges(text, record);
    return std::move(text).finish();
}

std::string truth_text(const std::string& sensor, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    ObjectText text({{"sensor", sensor},
                     {"scan", cast.revolution},
                     {"time_s", seconds(record.told(cast.start))},
                     {"stamp_ms", record.stamp_ms},
                     {"backend", record.backend->backend},
                     {"backend_reason", reason_of(*record.backend)}});
    add_poses(text, record);
    text.add("steps", steps_of(record.sent));
    add_all_hits(text, cast, *record.scene);
    text.add("sent_mm", record.sent.distance);
    text.add("intensity", record.sent.intensity);
    add_stages(text, record);
    return std::move(text).finish();
}

std::string truth_text(const std::string& sensor, const StaringRecord& record) {
    ObjectText text({{"sensor", sensor},
                     {"scan", record.cast->revolution},
                     {"time_s", seconds(record.told(record.cast->start))},
                     {"backend", record.backend->backend},
                     {"backend_reason", reason_of(*record.backend)}});
    add_poses(text, record);
    add_all_hits(text, *record.cast, *record.scene);
    add_ranges(text, record);
    return std::move(text).finish();
}

}  // namespace scipd::daemon
