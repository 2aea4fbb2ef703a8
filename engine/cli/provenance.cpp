// SPDX-License-Identifier: MIT
#include "cli/provenance.h"

#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include "cli/version.h"

namespace millstudy::cli {
namespace {

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

}  // namespace

std::string this_process() {
  return fmt::format("process {} on {}", getpid(), host_name());
}

std::vector<sweep::Attribute> provenance(int threads) {
  const Build made = build();
  return {
      {"millstudy_version", made.version},
      {"git_revision", made.git_revision},
      {"git_dirty", std::int64_t{made.git_dirty}},
      {"isa", made.isa},
      {"compiler", made.compiler},
      {"created", utc_now()},
      {"host", host_name()},
      {"threads", std::int64_t{threads}},
  };
}

}  // namespace millstudy::cli
