// SPDX-License-Identifier: MIT
#include "cli/provenance.h"

#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include "cli/extension.h"
#include "cli/version.h"
#include "study/sweep_design.h"

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

std::vector<sweep::Attribute> origin(const OpenStudy& open, const StudyOptions& options,
                                     int threads) {
  std::string overrides;
  for (const std::string& text : options.overrides) overrides += text + '\n';
  std::vector<sweep::Attribute> attributes = {
      {"title", open.study.description.empty() ? open.study.name : open.study.description},
      {"name", open.study.name},
      {"kind", std::string(open.study.kind->name)},
      {"schema_version", std::int64_t{1}},
      {"design", std::string(study::name_of(open.study.space.design()))},
      {"study", open.text},
      {"overrides", overrides},
      {"study_hash", open.hash},
  };
  for (sweep::Attribute& attribute : extension_attributes(open.study)) {
    attributes.push_back(std::move(attribute));
  }
  for (sweep::Attribute& attribute : provenance(threads)) {
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

}  // namespace millstudy::cli
