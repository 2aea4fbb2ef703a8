// SPDX-License-Identifier: MIT
// The verb merge: results of the parts of one study become the result of all of it.
#include <algorithm>
#include <fcntl.h>
#include <fmt/core.h>
#include <optional>
#include <set>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "core/error.h"
#include "io/packed_points.h"
#include "io/result_blocks.h"
#include "io/result_reader.h"
#include "io/result_writer.h"
#include "sweep/copy_point.h"

namespace millstudy::cli {
namespace {

/// Points of a block.
std::int64_t at_once(const sweep::Layout& layout) {
  return layout.traces ? 256 : 1 << 16;
}

/// Ranges of points for messages: "0 to 99, 300 to 399".
class Ranges {
 public:
  void add(std::int64_t point) {
    ++points_;
    if (!ranges_.empty() && ranges_.back().second == point - 1) {
      ranges_.back().second = point;
    } else if (ranges_.size() < kMost) {
      ranges_.emplace_back(point, point);
    } else {
      more_ = true;
    }
  }
  bool empty() const { return points_ == 0; }
  std::string text() const {
    std::string all;
    for (const auto& [from, to] : ranges_) {
      all += fmt::format("{}{}{}", all.empty() ? "" : ", ", from,
                         from == to ? "" : fmt::format(" to {}", to));
    }
    return fmt::format("{} points: {}{}", count_text(points_), all, more_ ? ", ..." : "");
  }

 private:
  static constexpr std::size_t kMost = 20;
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges_;
  std::int64_t points_ = 0;
  bool more_ = false;
};

struct Counts {
  std::int64_t ok = 0, failed = 0, skipped = 0;
};

/// A part of a study: what its file says of itself, and the points first .. end - 1 that it is of.
struct Part {
  Part(std::string file, std::int64_t points) : path(std::move(file)) {
    const std::optional<io::ResultSummary> found = io::read_result_summary(path);
    if (!found) throw core::InputError({path, 0}, "is no file that can be read");
    summary = *found;
    if (text("study_hash").empty()) throw core::InputError({path, 0}, "is no result of a study");
    first = std::clamp<std::int64_t>(summary.integer("shard_first_point").value_or(0), 0, points);
    end = first + std::clamp<std::int64_t>(summary.integer("shard_points").value_or(points), 0,
                                           points - first);
  }

  std::string text(const char* name) const { return summary.text(name).value_or(""); }

  std::string path;
  io::ResultSummary summary;
  std::int64_t first = 0;
  std::int64_t end = 0;
  std::optional<io::ResultBlocks> result;  ///< while its points are read
};

/// @throws core::InputError if a part is not of the same study by the same program as the first
void check_same(const Part& first, const Part& other) {
  if (first.text("study_hash") != other.text("study_hash")) {
    throw core::InputError({other.path, 0},
                           fmt::format("is the result of another study than {}", first.path));
  }
  for (const char* const name : {"isa", "millstudy_version", "git_revision"}) {
    if (first.text(name) == other.text(name)) continue;
    throw core::InputError({other.path, 0},
                           fmt::format("was computed with {} = {}, {} with {}: digits may differ",
                                       name, other.text(name), first.path, first.text(name)));
  }
}

/// @throws core::InputError if a part has not the points and variables of all
void check_alike(const sweep::Layout& all, const io::ResultBlocks& part) {
  const sweep::Layout& own = part.layout();
  const bool alike = all.shape == own.shape && all.columns.size() == own.columns.size() &&
                     all.traces == own.traces &&
                     std::equal(all.columns.begin(), all.columns.end(), own.columns.begin(),
                                [](const auto& x, const auto& y) { return x.name == y.name; });
  if (!alike) throw core::InputError({part.path(), 0}, "has other variables than the other parts");
}

/// Where the points from `first` on are those of other parts: a part is read in few pieces, for
/// each piece costs the unpacking of all chunks that it touches.
std::int64_t next_border(const std::vector<Part>& parts, std::int64_t first, std::int64_t points) {
  std::int64_t border = points;
  for (const Part& part : parts) {
    for (const std::int64_t one : {part.first, part.end}) {
      if (one > first) border = std::min(border, one);
    }
  }
  return border;
}

/// Points on their way: as they are packed in a part, or read.
struct Points {
  bool are_packed = false;
  io::PackedPoints packed;
  sweep::Block block{0, 0, 0, false};

  std::int64_t count() const { return are_packed ? packed.count : block.count; }
};

/// Has the disk read what will be needed, while other things are done; only a hint.
void read_ahead(const std::string& path) {
  constexpr off_t kMost = 64 << 20;  // bytes
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  ::posix_fadvise(fd, 0, kMost, POSIX_FADV_WILLNEED);
  ::close(fd);
}

/// The points of all parts, in order; who has a point that another has too is told.
class Joined {
 public:
  /// @param chunk  shape of those of the output
  Joined(std::vector<Part>& parts, const sweep::Layout& layout, const io::Shape& chunk)
      : parts_(parts), layout_(layout), chunk_(chunk) {}

  /// The next points: those of a chunk as it is, or as many as are in the same parts, within limits
  /// of memory. A part is open while it has such.
  void read(Points& points) {
    const std::int64_t first = next_;
    const std::int64_t border = next_border(parts_, first, layout_.points());
    std::vector<const io::ResultBlocks*> here;
    for (Part& part : parts_) {
      if (part.end <= first) part.result.reset();
      if (part.first <= first && first < part.end) here.push_back(&open(part));
    }
    const bool is_alike = here.size() == 1 && here[0]->layout().chunk == chunk_;
    points.are_packed = is_alike && here[0]->read_packed(first, border, points.packed);
    if (points.are_packed) {
      counts_.ok += points.packed.count;
    } else {
      std::int64_t end = std::min(first + at_once(layout_), border);
      // Perhaps the next chunk can be taken as it is.
      if (is_alike) end = std::min(end, here[0]->chunk_end(first));
      read_block(here, end, points.block);
    }
    next_ += points.count();
  }
  const Ranges& twice() const { return twice_; }
  const Ranges& missing() const { return missing_; }
  const Counts& counts() const { return counts_; }

 private:
  const io::ResultBlocks& open(Part& part) const {
    if (part.result) return *part.result;
    for (const Part& next : parts_) {
      if (next.first == part.end) read_ahead(next.path);
    }
    check_alike(layout_, part.result.emplace(part.path));
    return *part.result;
  }

  void read_block(const std::vector<const io::ResultBlocks*>& here, std::int64_t end,
                  sweep::Block& block) {
    const std::int64_t count = end - next_;
    if (here.size() == 1) here[0]->read(next_, count, block);  // mostly
    if (here.size() != 1 || block.values.empty()) {
      block = sweep::Block(next_, count, layout_.columns.size(), layout_.traces);
      for (const io::ResultBlocks* part : here) add(part->read(next_, count), block);
    }
    count_statuses(block);
  }

  /// Points that were run, and that the block does not have yet.
  void add(sweep::Block own, sweep::Block& block) {
    for (std::int64_t i = 0; i < own.count; ++i) {
      if (own.status[i] == sweep::Status::not_run) continue;
      if (block.status[i] != sweep::Status::not_run) {
        twice_.add(own.first + i);
        continue;
      }
      sweep::copy_point(own, i, block, i);
    }
  }

  void count_statuses(const sweep::Block& block) {
    for (std::int64_t i = 0; i < block.count; ++i) {
      if (block.status[i] == sweep::Status::not_run) missing_.add(block.first + i);
      counts_.ok += block.status[i] == sweep::Status::ok;
      counts_.failed += block.status[i] == sweep::Status::failed;
      counts_.skipped += block.status[i] == sweep::Status::skipped;
    }
  }

  std::vector<Part>& parts_;
  const sweep::Layout& layout_;
  const io::Shape& chunk_;
  std::int64_t next_ = 0;
  Ranges twice_, missing_;
  Counts counts_;
};

void write_all(Joined& joined, std::int64_t points, io::ResultSink& writer) {
  Points some;
  for (std::int64_t next = 0; next < points; next += some.count()) {
    joined.read(some);
    some.are_packed ? writer.write(some.packed) : writer.write(some.block);
  }
}

/// That of a part without what is said of parts alone.
sweep::Layout layout_of_all(sweep::Layout layout) {
  const std::set<std::string> own = {"shard",          "shard_first_point", "shard_points",
                                     "points_ok",      "points_failed",     "points_skipped",
                                     "points_not_run", "wall_time_s"};
  std::erase_if(layout.attributes,
                [&](const sweep::Attribute& attribute) { return own.contains(attribute.first); });
  return layout;
}

double wall_time(const std::vector<Part>& parts) {
  double sum = 0.0;
  for (const Part& part : parts) sum += part.summary.real("wall_time_s").value_or(0.0);
  return sum;
}

}  // namespace

int merge(const std::string& output, const std::vector<std::string>& files) {
  const sweep::Layout layout = layout_of_all(io::ResultBlocks(files[0]).layout());
  std::vector<Part> parts;
  for (const std::string& file : files) {
    if (file == output) throw core::InputError({file, 0}, "is the output of the merge itself");
    parts.emplace_back(file, layout.points());
    check_same(parts.front(), parts.back());
  }
  const auto writer = io::make_result_writer(output, layout);
  Joined joined(parts, layout, writer->chunk());
  write_all(joined, layout.points(), *writer);
  std::vector<core::Fault> faults;
  const auto check = [&](const Ranges& points, const char* what) {
    if (points.empty()) return;
    faults.emplace_back();
    faults.back().place.file = output;
    faults.back().text = fmt::format("{} {}", what, points.text());
  };
  check(joined.twice(), "cannot be made: in more than one part are");
  check(joined.missing(), "cannot be made: in no part are");
  if (!faults.empty()) throw core::InputError(std::move(faults));
  const Counts& counts = joined.counts();
  writer->finish({{"points_ok", counts.ok},
                  {"points_failed", counts.failed},
                  {"points_skipped", counts.skipped},
                  {"merged_from", static_cast<std::int64_t>(parts.size())},
                  {"wall_time_s", wall_time(parts)}});
  fmt::print("{}: {} points of {} parts, {} ok, {} failed, {} skipped\n", output,
             count_text(layout.points()), parts.size(), count_text(counts.ok),
             count_text(counts.failed), count_text(counts.skipped));
  return counts.failed > 0 ? kPointsFailed : kDone;
}

}  // namespace millstudy::cli
