// SPDX-License-Identifier: MIT
// libFuzzer target of study files and fit files: any text gives one or an InputError. What follows
// a zero byte is the text of every file that is named. Only the readers of TOML and of studies are
// instrumented: what reads the sections of fit files runs as it was built.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "allow_input_errors.h"
#include "core/error.h"
#include "io/toml_reader.h"
#include "study/fit_file.h"
#include "study/study.h"

namespace {

using namespace millstudy;

/// All that happens between reading a study and computing its points.
void check(const study::Study& study) {
  if (study.canonical.empty() || study.settings.empty()) std::abort();
  if (layout(study).columns.empty()) std::abort();
  const std::int64_t points = study.space.points();
  if (points < 1) std::abort();
  for (const std::int64_t point : {std::int64_t{0}, points / 2, points - 1}) case_at(study, point);
  for (const study::Axis& axis : study.axes) {
    if (axis.size() == 0) std::abort();
    if (!axis.numeric() && label_text(axis, axis.size() - 1).empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = all.find('\0');
  const std::string_view text = all.substr(0, end);
  const std::string_view file = end == all.npos ? std::string_view() : all.substr(end + 1);
  const auto load = [&](const std::string& path) { return io::parse_toml(file, path); };
  allow_input_errors([&] {
    const core::Value root = io::parse_toml(text, "fuzz.toml");
    allow_input_errors([&] { check(study::resolve(root, load)); });
    allow_input_errors([&] {
      if (study::read_fit_file(root, load).records.empty()) std::abort();
    });
  });
  return 0;
}
