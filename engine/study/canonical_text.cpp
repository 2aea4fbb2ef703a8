// SPDX-License-Identifier: MIT
#include "study/canonical_text.h"

#include <fmt/format.h>
#include <set>

namespace millstudy::study {
namespace {

std::string text_of(const Axis& axis) {
  if (!axis.sampled.empty()) return fmt::format("axis {} = {}", axis.path, axis.sampled);
  std::string text = fmt::format("axis {} = {}", axis.path, fmt::join(axis.numbers, " "));
  for (std::size_t i = 0; i < axis.labels.size(); ++i) {
    text += fmt::format(" [{}", axis.labels[i]);
    for (const Assignment& assignment : axis.settings[i]) {
      text += fmt::format(" {} = {}", assignment.key->path, to_string(assignment.setting));
    }
    text += ']';
  }
  return text;
}

std::string text_of(const Limit& limit) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "-";
  };
  return fmt::format("where {} {} {}", limit.quantity, bound(limit.min), bound(limit.max));
}

}  // namespace

std::string canonical_text(const Study& study, const SettingMap& settings, const Given& given) {
  const Outputs& outputs = study.outputs;
  std::string text =
      fmt::format("millstudy study 1\nkind {}\ntraces {}\nharmonics {}\nflutes {}\n",
                  study.kind->name, outputs.traces, outputs.harmonics, outputs.flutes);
  for (const auto& [path, setting] : settings) {
    const Key* key = study.kind->find_key(path);
    if (key->field && !given.swept(path))
      text += fmt::format("{} = {}\n", path, to_string(setting));
  }
  if (study.axes.empty()) return text;
  text += study.space.design() == sweep::Design::grid ? "grid\n" : "zip\n";
  for (const Axis& axis : study.axes) text += text_of(axis) + '\n';
  std::set<std::string> limits;  // their order does not count
  for (const Limit& limit : study.limits) limits.insert(text_of(limit));
  for (const std::string& limit : limits) text += limit + '\n';
  return text;
}

}  // namespace millstudy::study
