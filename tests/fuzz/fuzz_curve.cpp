// SPDX-License-Identifier: MIT
// libFuzzer target of TOML and the files of curves and profiles: any text gives one or an
// InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "allow_input_errors.h"
#include "io/toml_reader.h"
#include "study/curve_file.h"
#include "study/profile_file.h"

namespace {

using namespace millstudy;

void check(const study::StudyCurve& read) {
  const path::Curve& curve = read.curve;
  if (!(curve.begin() < curve.end())) std::abort();
  for (int i = 0; i <= 16; ++i) {
    const double u = curve.begin() + (curve.end() - curve.begin()) * i / 16;
    const auto point = curve.evaluate(u).position;
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  allow_input_errors([&] {
    const core::Value table = io::parse_toml(text, "fuzz.toml");
    allow_input_errors([&] { check(*study::read_curve(table)); });
    allow_input_errors([&] {
      if (study::read_profile(table)->size() < 2) std::abort();
    });
  });
  return 0;
}
