// SPDX-License-Identifier: MIT
// The verb merge: results of the parts of one study become the result of all of it.
#include <algorithm>
#include <fmt/core.h>
#include <set>

#include "cli/commands.h"
#include "cli/progress.h"
#include "core/error.h"
#include "io/result_blocks.h"
#include "io/result_writer.h"
#include "sweep/attributes.h"
#include "sweep/copy_point.h"

namespace millstudy::cli {
namespace {

/// Points in memory.
std::int64_t at_once(const sweep::Layout& layout) {
  return layout.traces ? 256 : 1 << 16;
}

/// @throws core::InputError if a part is not of the same study by the same program as the first
void check_same(const io::ResultBlocks& first, const io::ResultBlocks& other) {
  const auto refuse = [&](const std::string& why) {
    throw core::InputError({other.path(), 0}, why);
  };
  const sweep::Layout &a = first.layout(), &b = other.layout();
  if (sweep::text_attribute(a, "study_hash") != sweep::text_attribute(b, "study_hash")) {
    refuse(fmt::format("is the result of another study than {}", first.path()));
  }
  for (const char* const name : {"isa", "millstudy_version", "git_revision"}) {
    if (sweep::text_attribute(a, name) == sweep::text_attribute(b, name)) continue;
    refuse(fmt::format("was computed with {} = {}, {} with {}: digits may differ", name,
                       sweep::text_attribute(b, name), first.path(),
                       sweep::text_attribute(a, name)));
  }
  const bool alike = a.shape == b.shape && a.columns.size() == b.columns.size() &&
                     a.traces == b.traces &&
                     std::equal(a.columns.begin(), a.columns.end(), b.columns.begin(),
                                [](const auto& x, const auto& y) { return x.name == y.name; });
  if (!alike) refuse(fmt::format("has other variables than {}", first.path()));
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

/// A part of a study, and the points first .. end - 1 that it is of.
struct Part {
  explicit Part(const std::string& file) : result(file) {
    const sweep::Layout& layout = result.layout();
    const std::int64_t points = layout.points();
    first = std::clamp<std::int64_t>(
        sweep::attribute<std::int64_t>(layout, "shard_first_point").value_or(0), 0, points);
    end = first + std::clamp<std::int64_t>(
                      sweep::attribute<std::int64_t>(layout, "shard_points").value_or(points), 0,
                      points - first);
  }

  io::ResultBlocks result;
  std::int64_t first;
  std::int64_t end;
};

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

/// The points of all parts; who has a point that another has too is told.
class Joined {
 public:
  explicit Joined(const std::vector<Part>& parts) : parts_(parts) {}

  /// Points from `first` on: as many as are in the same parts, at most so many.
  const sweep::Block& read(std::int64_t first, std::int64_t most) {
    const sweep::Layout& layout = parts_[0].result.layout();
    const std::int64_t border = next_border(parts_, first, layout.points());
    std::int64_t end = std::min(first + most, border);
    std::vector<const Part*> here;
    for (const Part& part : parts_) {
      if (part.first <= first && first < part.end) here.push_back(&part);
    }
    if (end < border && !here.empty()) end = here[0]->result.last_border(first, end);
    const std::int64_t count = end - first;
    if (here.size() == 1) here[0]->result.read(first, count, block_);  // mostly
    if (here.size() != 1 || block_.values.empty()) {
      block_ = sweep::Block(first, count, layout.columns.size(), layout.traces);
      for (const Part* part : here) add(part->result.read(first, count));
    }
    count_statuses();
    return block_;
  }
  const Ranges& twice() const { return twice_; }
  const Ranges& missing() const { return missing_; }
  const Counts& counts() const { return counts_; }

 private:
  /// Points that were run, and that the block does not have yet.
  void add(sweep::Block own) {
    for (std::int64_t i = 0; i < own.count; ++i) {
      if (own.status[i] == sweep::Status::not_run) continue;
      if (block_.status[i] != sweep::Status::not_run) {
        twice_.add(own.first + i);
        continue;
      }
      sweep::copy_point(own, i, block_, i);
    }
  }

  void count_statuses() {
    for (std::int64_t i = 0; i < block_.count; ++i) {
      if (block_.status[i] == sweep::Status::not_run) missing_.add(block_.first + i);
      counts_.ok += block_.status[i] == sweep::Status::ok;
      counts_.failed += block_.status[i] == sweep::Status::failed;
      counts_.skipped += block_.status[i] == sweep::Status::skipped;
    }
  }

  const std::vector<Part>& parts_;
  sweep::Block block_{0, 0, 0, false};
  Ranges twice_, missing_;
  Counts counts_;
};

/// Wall time and shard are those of parts.
sweep::Layout layout_of_all(const std::vector<Part>& parts) {
  sweep::Layout layout = parts[0].result.layout();
  const std::set<std::string> own = {"shard",          "shard_first_point", "shard_points",
                                     "points_ok",      "points_failed",     "points_skipped",
                                     "points_not_run", "wall_time_s"};
  std::erase_if(layout.attributes,
                [&](const sweep::Attribute& attribute) { return own.contains(attribute.first); });
  return layout;
}

double wall_time(const std::vector<Part>& parts) {
  double sum = 0.0;
  for (const Part& part : parts) {
    sum += sweep::attribute<double>(part.result.layout(), "wall_time_s").value_or(0.0);
  }
  return sum;
}

}  // namespace

int merge(const std::string& output, const std::vector<std::string>& files) {
  std::vector<Part> parts;
  for (const std::string& file : files) {
    if (file == output) throw core::InputError({file, 0}, "is the output of the merge itself");
    parts.emplace_back(file);
    check_same(parts.front().result, parts.back().result);
  }
  const sweep::Layout layout = layout_of_all(parts);
  const auto writer = io::make_result_writer(output, layout);
  Joined joined(parts);
  const std::int64_t step = at_once(layout);
  for (std::int64_t next = 0; next < layout.points();) {
    const sweep::Block& block = joined.read(next, step);
    writer->write(block);
    next += block.count;
    for (Part& part : parts) {
      if (part.end <= next) part.result.close();
    }
  }
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
