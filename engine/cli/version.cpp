// SPDX-License-Identifier: MIT
#include "cli/version.h"

#include "git_revision.h"  // made at every build by git_revision.cmake

namespace millstudy::cli {
namespace {

std::string instruction_set() {
  std::string isa =
#if defined(__x86_64__)
      "x86-64";
#elif defined(__aarch64__)
      "aarch64";
#else
      "unknown";
#endif
#ifdef __AVX__
  isa += " avx";
#endif
#ifdef __AVX2__
  isa += " avx2";
#endif
#ifdef __FMA__
  isa += " fma";
#endif
#ifdef __AVX512F__
  isa += " avx512f";
#endif
  return isa;
}

}  // namespace

Build build() {
  return {MILLSTUDY_VERSION, MILLSTUDY_GIT_REVISION, MILLSTUDY_GIT_DIRTY, "g++ " __VERSION__,
          instruction_set()};
}

std::string version_text() {
  const Build made = build();
  return "millstudy " + made.version + " (" + made.git_revision +
         (made.git_dirty ? ", changed)" : ")");
}

}  // namespace millstudy::cli
