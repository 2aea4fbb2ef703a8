// SPDX-License-Identifier: MIT
#include "cli/extension.h"

#include <algorithm>
#include <fmt/core.h>
#include <sstream>
#include <unordered_map>
#include <unordered_set>

#include "cli/run_journal.h"
#include "core/error.h"
#include "io/result_blocks.h"
#include "io/result_reader.h"
#include "io/sha256.h"
#include "sweep/attributes.h"
#include "sweep/copy_point.h"

namespace millstudy::cli {
namespace {

/// A label with what it sets: the name of a file is not enough, it may have changed.
std::string label_line(const study::Axis& axis, std::size_t i) {
  return fmt::format("{} {} {}", io::sha256_hex(label_text(axis, i)), axis.path, axis.labels[i]);
}

std::string label_lines(const study::Study& study) {
  std::string lines;
  std::unordered_set<std::string> seen;  // sampled labels come many times
  for (const study::Axis& axis : study.axes) {
    for (std::size_t i = 0; i < axis.labels.size(); ++i) {
      if (!seen.insert(axis.path + ' ' + axis.labels[i]).second) continue;
      lines += label_line(axis, i) + '\n';
    }
  }
  return lines;
}

/// The points of an old result by their parameters.
class OldPoints {
 public:
  OldPoints(const io::ResultBlocks& old, const study::Study& study) : study_(study) {
    const sweep::Layout& layout = old.layout();
    points_ = layout.points();
    grid_ = layout.dimensions.size() == layout.coordinates.size() &&
            !(layout.dimensions.size() == 1 && layout.dimensions[0] == "point");
    std::unordered_set<std::string> labels;
    std::istringstream lines(sweep::text_attribute(layout, "label_hashes"));
    for (std::string line; std::getline(lines, line);) labels.insert(line);
    for (const study::Axis& axis : study.axes) {
      const auto at = std::find_if(layout.coordinates.begin(), layout.coordinates.end(),
                                   [&](const auto& c) { return c.key == axis.path; });
      if (at == layout.coordinates.end()) {
        throw core::InputError({old.path(), 0}, "has no coordinate for " + axis.path);
      }
      axes_.push_back(make_axis(axis, *at, labels));
      places_.push_back(at - layout.coordinates.begin());
    }
    std::int64_t stride = points_;
    for (std::size_t d = 0; grid_ && d < layout.shape.size(); ++d) {
      stride /= layout.shape[d];
      strides_.push_back(stride);
    }
    if (!grid_) {
      for (std::int64_t point = 0; point < points_; ++point) {
        by_values_.emplace(key_of([&](std::size_t a) { return axes_[a].old_ids[point]; }), point);
      }
    }
    indices_.resize(study.axes.size());
  }

  /// The number that a point of the new study had; -1: it is new.
  std::int64_t old_of(std::int64_t point) {
    study_.space.indices(point, indices_);
    std::int64_t sum = 0;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const std::int64_t id = axes_[a].new_ids[indices_[a]];
      if (id < 0) return -1;
      if (grid_) sum += id * strides_[places_[a]];
    }
    if (grid_) return sum;
    const auto id = [&](std::size_t a) { return axes_[a].new_ids[indices_[a]]; };
    const auto found = by_values_.find(key_of(id));
    return found == by_values_.end() ? -1 : found->second;
  }

 private:
  /// Equal values of an axis have equal numbers; that of a grid's is the index in the old result.
  struct AxisIds {
    std::vector<std::int64_t> old_ids;
    std::vector<std::int64_t> new_ids;  // -1: no old point has this value
  };

  template <class Value>
  static AxisIds ids_of(const std::vector<Value>& old_values, const std::vector<Value>& values) {
    AxisIds ids;
    std::unordered_map<Value, std::int64_t> known;
    for (const Value& value : old_values) {
      ids.old_ids.push_back(
          known.emplace(value, static_cast<std::int64_t>(known.size())).first->second);
    }
    for (const Value& value : values) {
      const auto found = known.find(value);
      ids.new_ids.push_back(found == known.end() ? -1 : found->second);
    }
    return ids;
  }

  static AxisIds make_axis(const study::Axis& axis, const sweep::Coordinate& old,
                           const std::unordered_set<std::string>& labels) {
    if (axis.numeric()) {
      const auto* numbers = std::get_if<std::vector<double>>(&old.values);
      return ids_of(numbers ? *numbers : std::vector<double>{}, axis.numbers);
    }
    const auto* texts = std::get_if<std::vector<std::string>>(&old.values);
    AxisIds ids = ids_of(texts ? *texts : std::vector<std::string>{}, axis.labels);
    std::unordered_map<std::string, bool> same;
    for (std::size_t i = 0; i < axis.labels.size(); ++i) {
      const auto known = same.find(axis.labels[i]);
      const bool is_same =
          known != same.end() ? known->second : labels.contains(label_line(axis, i));
      same.emplace(axis.labels[i], is_same);
      if (!is_same) ids.new_ids[i] = -1;
    }
    return ids;
  }

  /// All numbers of a point in one text of bytes.
  template <class IdOf>
  std::string key_of(const IdOf& id_of) const {
    std::string key(sizeof(std::int64_t) * axes_.size(), '\0');
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const std::int64_t id = id_of(a);
      std::copy_n(reinterpret_cast<const char*>(&id), sizeof id, key.data() + a * sizeof id);
    }
    return key;
  }

  const study::Study& study_;
  std::int64_t points_ = 0;
  bool grid_ = false;
  std::vector<AxisIds> axes_;
  std::vector<std::ptrdiff_t> places_;  // of each axis among the old coordinates
  std::vector<std::int64_t> strides_;   // of the old dimensions
  std::unordered_map<std::string, std::int64_t> by_values_;
  std::vector<std::int64_t> indices_;
};

struct Match {
  std::int64_t old = 0;
  std::int64_t block = 0;
  std::int64_t within = 0;
};

}  // namespace

std::vector<sweep::Attribute> extension_attributes(const study::Study& study) {
  return {{"settings_hash", io::sha256_hex(study.settings)}, {"label_hashes", label_lines(study)}};
}

void check_extends(const std::string& result, const OpenStudy& open) {
  const auto summary = io::read_result_summary(result).value_or(io::ResultSummary{});
  if (summary.text("settings_hash") != io::sha256_hex(open.study.settings)) {
    throw core::InputError({result, 0},
                           "is of a study with other settings, limits or axes: --extend is for "
                           "other values on the same axes");
  }
  if (summary.text("shard").value_or("") != "") {
    throw core::InputError({result, 0}, "holds a part of a study: merge the parts first");
  }
  check_same_program(result);
}

std::int64_t reuse_points(sweep::Journal& journal, const std::string& result,
                          const study::Study& study) {
  const io::ResultBlocks old(result);
  OldPoints points(old, study);
  const sweep::JournalHeader& header = journal.contents().header;
  const std::int64_t at_once = header.traces ? 64 : 1 << 14;  // points in memory
  const std::int64_t gap = header.traces ? 1 : 256;  // so far apart points are read together
  const std::int64_t blocks_at_once = std::max<std::int64_t>(1, at_once / header.block_size);
  std::int64_t reused = 0;
  const std::vector<std::int64_t> pending = journal.pending();
  for (std::size_t begin = 0; begin < pending.size();) {
    const std::size_t end =
        std::min(pending.size(), begin + static_cast<std::size_t>(blocks_at_once));
    std::vector<sweep::Block> blocks;
    std::vector<Match> matches;
    for (std::size_t b = begin; b < end; ++b) {
      blocks.push_back(journal.read(pending[b]));
      const sweep::Block& block = blocks.back();
      for (std::int64_t i = 0; i < block.count; ++i) {
        if (block.status[i] != sweep::Status::not_run) continue;
        const std::int64_t there = points.old_of(block.first + i);
        if (there >= 0) matches.push_back({there, static_cast<std::int64_t>(b - begin), i});
      }
    }
    std::sort(matches.begin(), matches.end(),
              [](const Match& a, const Match& b) { return a.old < b.old; });
    for (std::size_t m = 0; m < matches.size();) {
      const std::int64_t first = matches[m].old;
      std::size_t last = m;
      while (last + 1 < matches.size() && matches[last + 1].old - matches[last].old <= gap &&
             matches[last + 1].old - first < at_once) {
        ++last;
      }
      sweep::Block read = old.read(first, matches[last].old - first + 1);
      for (; m <= last; ++m) {
        const std::int64_t k = matches[m].old - first;
        reused += read.status[k] != sweep::Status::not_run;
        sweep::copy_point(read, k, blocks[matches[m].block], matches[m].within);
      }
    }
    for (const sweep::Block& block : blocks) {
      const bool any =
          std::any_of(block.status.begin(), block.status.end(),
                      [](sweep::Status status) { return status != sweep::Status::not_run; });
      if (any) journal.append(block, {});
    }
    begin = end;
  }
  return reused;
}

}  // namespace millstudy::cli
