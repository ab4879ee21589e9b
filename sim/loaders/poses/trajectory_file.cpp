// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/trajectory_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sim/expected.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/poses/pose_columns.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/pose.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr std::array kitti_columns{"r11", "r12", "r13", "x",   "r21", "r22",
                                   "r23", "y",   "r31", "r32", "r33", "z"};

/// Each column is an axis of the camera in our frame: right is -y, down is -z, ahead is x.
const glm::dmat3 ours_from_camera{glm::dvec3{0.0, -1.0, 0.0}, glm::dvec3{0.0, 0.0, -1.0},
                                  glm::dvec3{1.0, 0.0, 0.0}};

/// True within the tolerance that numbers of six digits need.
bool is_rotation(const glm::dmat3& matrix) {
    constexpr double tolerance = 1e-3;
    const glm::dmat3 square = glm::transpose(matrix) * matrix;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(square[i][k] - (i == k ? 1.0 : 0.0)) <= tolerance)) return false;
        }
    }
    return glm::determinant(matrix) > 0.0;
}

/// One line of KITTI's odometry ground truth: the first three rows of a camera's pose, as a matrix,
/// in the frame that the camera had at first. KITTI's cameras have x to the right, y down and z
/// ahead; here both frames are turned to x ahead, y to the left, z up, as everywhere in a world. So
/// the drive begins at the origin, looking along x.
Expected<Pose> parse_kitti_line(std::string_view line) {
    const auto cells = cells_of(line, ' ');
    if (cells.size() != kitti_columns.size()) {
        return refuse("a pose has 12 columns, the rows of [R t], this line has " +
                      std::to_string(cells.size()));
    }
    std::array<double, kitti_columns.size()> value{};
    for (std::size_t i = 0; i < value.size(); ++i) {
        const auto number = parse_number(cells[i]);
        if (!number) {
            return refuse(std::string{kitti_columns[i]} + " must be a finite number, not " +
                          quote(cells[i]));
        }
        value[i] = *number;
    }
    // GLM's matrices are columns.
    const glm::dmat3 rotation{glm::dvec3{value[0], value[4], value[8]},
                              glm::dvec3{value[1], value[5], value[9]},
                              glm::dvec3{value[2], value[6], value[10]}};
    if (!is_rotation(rotation)) return refuse("r11 to r33 must be a rotation");
    const glm::dvec3 xyz_m = ours_from_camera * glm::dvec3{value[3], value[7], value[11]};
    if (!plausible_position(xyz_m)) return refuse("x, y and z must lie within 1e7 m of the origin");
    const glm::dmat3 turned = ours_from_camera * rotation * glm::transpose(ours_from_camera);
    return Pose{xyz_m, glm::normalize(glm::quat_cast(turned))};
}

/// Half of what a Time can hold.
constexpr std::chrono::duration<double> longest_trajectory{4.5e9};

/// A trajectory while its file is read line by line: the poses so far and every fault, so that a
/// user sees all faults at once. It knows no format.
class TrajectoryDraft {
  public:
    /// Messages begin with the file.
    explicit TrajectoryDraft(const std::filesystem::path& file) : file_(file.string()) {}

    void begin_line() { ++line_number_; }
    /// Leaves the pose out if it has the stamp of the one before it: some recorders write a pose
    /// twice.
    void append(const TimedPose& next);
    /// Adds a fault of this line.
    void add_fault(const std::string& text);
    /// Adds a fault of the whole file.
    void refuse(const std::string& text) { faults_.push_back(file_ + ": " + text); }
    void warn(const std::string& text) { warnings_.push_back(file_ + ": " + text); }

    /// Throws LoadError where anything is wrong or there is no pose. `a_line` shows the user what a
    /// line looks like.
    Trajectory finish(const std::string& a_line) &&;

  private:
    std::string file_;
    std::size_t line_number_ = 0;
    std::size_t fault_count_ = 0;
    std::size_t repeated_count_ = 0;
    std::size_t first_repeated_line_ = 0;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    std::vector<TimedPose> poses_;
};

/// Past this many faults a file is not a trajectory at all, and a list of them helps nobody.
constexpr std::size_t fault_limit = 100;

using Seconds = std::chrono::duration<double>;

void TrajectoryDraft::append(const TimedPose& next) {
    if (!poses_.empty() && next.time == poses_.back().time) {
        if (++repeated_count_ == 1) first_repeated_line_ = line_number_;
        return;
    }
    if (!poses_.empty() && next.time < poses_.back().time) {
        return add_fault("t must be later than the pose before it");
    }
    // In floating point: they may lie farther apart than a Time can tell.
    if (!poses_.empty() && Seconds(next.time) - Seconds(poses_.front().time) > longest_trajectory) {
        return add_fault("t must lie within 4.5e9 s of the first one");
    }
    poses_.push_back(next);
}

void TrajectoryDraft::add_fault(const std::string& text) {
    if (++fault_count_ > fault_limit) return;
    faults_.push_back(file_ + ':' + std::to_string(line_number_) + ": " + text);
}

Trajectory TrajectoryDraft::finish(const std::string& a_line) && {
    if (fault_count_ > fault_limit) {
        faults_.push_back(file_ + ": and " + std::to_string(fault_count_ - fault_limit) + " more");
    }
    if (poses_.empty() && faults_.empty()) {
        faults_.push_back(file_ + ": holds no pose; a line is " + a_line);
    }
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    if (repeated_count_ > 0) {
        warnings_.push_back(
            file_ + ':' + std::to_string(first_repeated_line_) +
            ": has the stamp of the pose before it, as " + std::to_string(repeated_count_) +
            (repeated_count_ == 1 ? " line does" : " lines do") + "; such poses are left out");
    }
    return {std::move(poses_), std::move(warnings_)};
}

namespace fs = std::filesystem;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// A week of a hundred poses a second is half of this.
constexpr std::uintmax_t largest_trajectory = 1U << 30U;

/// Hands each line to `use`, until that answers false.
template <typename Use>
void for_each_line(std::string_view text, const Use& use) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        if (!use(text.substr(0, end))) return;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// Hands the lines that say something to `use`, which adds to the draft.
template <typename Use>
void read_lines(std::string_view text, TrajectoryDraft& draft, const Use& use) {
    for_each_line(text, [&](std::string_view line) {
        draft.begin_line();
        if (!says_nothing(line)) use(line);
        return true;
    });
}

void add(const Expected<TimedPose>& pose, TrajectoryDraft& draft) {
    if (!pose) return draft.add_fault(pose.error().why);
    draft.append(*pose);
}

Trajectory read_tum(std::string_view text, TrajectoryDraft draft) {
    read_lines(text, draft, [&](std::string_view line) { add(parse_tum_line(line), draft); });
    return std::move(draft).finish("t tx ty tz qx qy qz qw");
}

Trajectory read_euroc(std::string_view text, TrajectoryDraft draft) {
    const PoseColumns columns = euroc_columns();
    read_lines(text, draft,
               [&](std::string_view line) { add(columns.pose_of(cells_of(line, ',')), draft); });
    return std::move(draft).finish("timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z");
}

void compare_counts(std::size_t poses, const Stamps& stamps, TrajectoryDraft& draft) {
    const std::size_t count = stamps.times.size();
    const std::string both = "has " + std::to_string(poses) + (poses == 1 ? " pose" : " poses") +
                             ", but there " + (count == 1 ? "is " : "are ") +
                             std::to_string(count) + (count == 1 ? " stamp" : " stamps") + " in " +
                             stamps.file.string();
    if (poses > count) draft.refuse(both + "; name the file of its stamps as `times`");
    if (poses < count) draft.warn(both + "; the rest is left out");
}

Trajectory read_kitti(std::string_view text, const std::optional<Stamps>& stamps,
                      TrajectoryDraft draft) {
    constexpr Time frame = std::chrono::milliseconds(100);
    std::size_t count = 0;
    read_lines(text, draft, [&](std::string_view line) {
        const std::size_t index = count++;
        if (stamps && index >= stamps->times.size()) return;
        const Time time = stamps ? stamps->times[index] : static_cast<Time::rep>(index) * frame;
        const auto at_time = [&](const Pose& pose) -> TimedPose { return {time, pose}; };
        add(parse_kitti_line(line).map(at_time), draft);
    });
    if (stamps) compare_counts(count, *stamps, draft);
    return std::move(draft).finish("r11 r12 r13 x r21 r22 r23 y r31 r32 r33 z");
}

char delimiter_of(std::string_view line) {
    for (const char delimiter : {';', ',', '\t'}) {
        if (line.find(delimiter) != line.npos) return delimiter;
    }
    return ' ';
}

/// The text of a comment, without the # before it.
std::string_view without_mark(std::string_view line) {
    line = trimmed(line);
    return trimmed(line.substr(std::min(line.find_first_not_of('#'), line.size())));
}

/// The unit that a stamp of this size must be in: seconds end at 9e9, and the milliseconds since
/// 1970 are 1.7e12 today.
int guessed_power(std::string_view stamp) {
    const double value = parse_number(stamp).value_or(0.0);
    if (value > 1e17) return -9;
    if (value > 1e14) return -6;
    return value > 1e11 ? -3 : 0;
}

class CsvReader {
  public:
    explicit CsvReader(TrajectoryDraft draft) : draft_(std::move(draft)) {}

    /// False: the header is wrong, so that the rest cannot be read.
    bool read(std::string_view line) {
        draft_.begin_line();
        const bool is_comment = says_nothing(line);
        if (columns_) {
            if (!is_comment) read_row(line);
        } else if (!trimmed(line).empty()) {
            return read_header(line, is_comment);
        }
        return true;
    }

    Trajectory finish() && {
        const bool one = not_read_count_ == 1;
        if (not_read_count_ > 0) {
            draft_.warn((one ? "the column " : "the columns ") + not_read_ +
                        (one ? " is not read" : " are not read"));
        }
        return std::move(draft_).finish("a row under a header such as t,x,y,z,roll,pitch,yaw");
    }

  private:
    /// The header may stand in a comment.
    bool read_header(std::string_view line, bool is_comment) {
        if (is_comment) line = without_mark(line);
        delimiter_ = delimiter_of(line);
        std::vector<std::string> not_read;
        const auto columns = named_columns(cells_of(line, delimiter_), not_read);
        if (!columns) {
            if (is_comment) return true;
            draft_.add_fault(columns.error().why);
            return false;
        }
        columns_ = *columns;
        for (const std::string& name : not_read)
            not_read_ += (not_read_.empty() ? "" : ", ") + name;
        not_read_ = printable(not_read_);
        not_read_count_ = not_read.size();
        return true;
    }

    void read_row(std::string_view line) {
        const auto cells = cells_of(line, delimiter_);
        if (!columns_->time_power && cells.size() > columns_->time.index)
            columns_->time_power = guessed_power(cells[columns_->time.index]);
        add(columns_->pose_of(cells), draft_);
    }

    TrajectoryDraft draft_;
    std::optional<PoseColumns> columns_;
    std::string not_read_;
    std::size_t not_read_count_ = 0;
    char delimiter_ = ',';
};

Trajectory read_csv(std::string_view text, TrajectoryDraft draft) {
    CsvReader reader{std::move(draft)};
    for_each_line(text, [&](std::string_view line) { return reader.read(line); });
    return std::move(reader).finish();
}

bool is_word(std::string_view cell) {
    return !cell.empty() && (std::isalpha(static_cast<unsigned char>(cell.front())) != 0);
}

/// Whether the first cell is whole nanoseconds since 1970, enough cells follow it, and no header
/// names other columns.
bool looks_like_euroc(const std::vector<std::string_view>& cells, std::string_view comment) {
    const std::string_view stamp = cells.front();
    const bool is_whole = stamp.find_first_of(".eE") == stamp.npos;
    if (cells.size() < 8 || !is_whole || guessed_power(stamp) != -9) return false;
    std::vector<std::string> not_read;
    const auto columns = named_columns(cells_of(without_mark(comment), ','), not_read);
    return !columns || columns->same_places(euroc_columns());
}

}  // namespace

TrajectoryFormat guessed_format(std::string_view text) {
    std::string_view first;
    std::string_view comment;
    for_each_line(text, [&](std::string_view line) {
        (says_nothing(line) ? comment : first) = trimmed(line);
        return first.empty();
    });
    const char delimiter = delimiter_of(first);
    const auto cells = cells_of(first, delimiter);
    if (is_word(cells.front())) return TrajectoryFormat::csv;
    if (delimiter == ',' || delimiter == ';') {
        return looks_like_euroc(cells, comment) ? TrajectoryFormat::euroc : TrajectoryFormat::csv;
    }
    return cells_of(first, ' ').size() == 12 ? TrajectoryFormat::kitti : TrajectoryFormat::tum;
}

TrajectoryFormat format_of(const fs::path& file) {
    return guessed_format(read_text(file, largest_trajectory, "name a trajectory"));
}

Stamps parse_stamps(std::string_view text, const fs::path& file) {
    using Seconds = std::chrono::duration<double>;
    std::vector<Time> times;
    std::size_t number = 0;
    const auto refuse = [&](const std::string& why) {
        throw LoadError({file.string() + ':' + std::to_string(number) + ": " + why});
    };
    for_each_line(text, [&](std::string_view line) {
        ++number;
        if (says_nothing(line)) return true;
        const auto time = parse_stamp(trimmed(line));
        if (!time) refuse("a line is the time of a pose in seconds, not " + quote(trimmed(line)));
        if (!times.empty() && *time < times.back()) refuse("is earlier than the stamp before it");
        if (!times.empty() && Seconds(*time) - Seconds(times.front()) > longest_trajectory)
            refuse("must lie within 4.5e9 s of the first stamp");
        times.push_back(*time);
        return true;
    });
    return {file, std::move(times)};
}

Trajectory load_trajectory(const fs::path& file, TrajectoryFormat format, const fs::path& times) {
    const std::string text = read_text(file, largest_trajectory, "name a trajectory");
    if (format == TrajectoryFormat::guess) format = guessed_format(text);
    const fs::path beside = file.parent_path() / "times.txt";
    // Whatever it is: one that cannot be read is told below.
    std::error_code error;
    const bool is_beside = times.empty() && fs::exists(fs::symlink_status(beside, error));
    const fs::path& stamps = is_beside ? beside : times;
    if (format != TrajectoryFormat::kitti || stamps.empty()) {
        return parse_trajectory(text, file, format);
    }
    const std::string lines =
        read_text(stamps, largest_trajectory, "the stamps of a trajectory are wanted");
    return parse_trajectory(text, file, format, parse_stamps(lines, stamps));
}

Trajectory parse_trajectory(std::string_view text, const fs::path& file, TrajectoryFormat format,
                            const std::optional<Stamps>& stamps) {
    if (format == TrajectoryFormat::guess) format = guessed_format(text);
    switch (format) {
        case TrajectoryFormat::euroc:
            return read_euroc(text, TrajectoryDraft{file});
        case TrajectoryFormat::kitti:
            return read_kitti(text, stamps, TrajectoryDraft{file});
        case TrajectoryFormat::csv:
            return read_csv(text, TrajectoryDraft{file});
        default:
            return read_tum(text, TrajectoryDraft{file});
    }
}

}  // namespace scipd::sim
