// SPDX-License-Identifier: MIT
#include "study/canonical_text.h"

#include <fmt/format.h>
#include <set>

namespace millstudy::study {
namespace {

std::string text_of(const Axis& axis) {
  if (!axis.sampled.empty()) return fmt::format("axis {} = {}", axis.path, axis.sampled);
  std::string text = fmt::format("axis {} = {}", axis.path, fmt::join(axis.numbers, " "));
  for (std::size_t i = 0; i < axis.labels.size(); ++i) text += ' ' + label_text(axis, i);
  return text;
}

std::string text_of(const Limit& limit) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "-";
  };
  return fmt::format("where {} {} {}", limit.quantity, bound(limit.min), bound(limit.max));
}

std::string limits_text(const Study& study) {
  std::set<std::string> limits;  // their order does not count
  for (const Limit& limit : study.limits) limits.insert(text_of(limit));
  std::string text;
  for (const std::string& limit : limits) text += limit + '\n';
  return text;
}

/// What is the same for all points.
std::string common_text(const Study& study, const SettingMap& settings, const Given& given) {
  const Outputs& outputs = study.outputs;
  std::string text =
      fmt::format("millstudy study 1\nkind {}\ntraces {}\nharmonics {}\nflutes {}\n",
                  study.kind->name, outputs.traces, outputs.harmonics, outputs.flutes);
  for (const auto& [path, setting] : settings) {
    const Key* key = study.kind->find_key(path);
    if (key->field && !given.swept(path))
      text += fmt::format("{} = {}\n", path, to_string(setting));
  }
  return text;
}

}  // namespace

std::string label_text(const Axis& axis, std::size_t i) {
  std::string text = '[' + axis.labels[i];
  for (const Assignment& assignment : axis.settings[i]) {
    text += fmt::format(" {} = {}", assignment.key->path, to_string(assignment.setting));
  }
  return text + ']';
}

std::string canonical_text(const Study& study, const SettingMap& settings, const Given& given) {
  std::string text = common_text(study, settings, given);
  if (study.axes.empty()) return text;
  text += study.space.design() == sweep::Design::grid ? "grid\n" : "zip\n";
  for (const Axis& axis : study.axes) text += text_of(axis) + '\n';
  return text + limits_text(study);
}

std::string settings_text(const Study& study, const SettingMap& settings, const Given& given) {
  std::set<std::string> axes;  // in any order
  for (const Axis& axis : study.axes) axes.insert(axis.path);
  return common_text(study, settings, given) +
         fmt::format("axes {}\n{}", fmt::join(axes, " "), limits_text(study));
}

}  // namespace millstudy::study
