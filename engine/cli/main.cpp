// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "cli/commands.h"
#include "cli/process_setup.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/resource_error.h"

namespace {

using namespace millstudy;

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const core::InputError& error) {
    constexpr std::size_t kMostLines = 100;  // a curve can have a million wrong points
    std::size_t lines = 0;
    for (const core::Fault& fault : error.faults()) {
      if (lines++ == kMostLines) break;
      std::fprintf(stderr, "%s\n", to_string(fault).c_str());
    }
    if (lines > kMostLines) {
      std::fprintf(stderr, "and %zu more\n", error.faults().size() - kMostLines);
    }
    return cli::kBadInput;
  } catch (const core::ResourceError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return cli::kInterrupted;
  } catch (const std::bad_alloc&) {
    std::fprintf(
        stderr,
        "out of memory: use fewer threads, or fewer samples per point; finished points are kept\n");
    return cli::kInterrupted;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
    return cli::kInternalError;
  }
}

/// One line that says what is wrong with the command and where to read on.
std::string usage_fault(const CLI::App* app, const CLI::Error& error) {
  std::string command = app->get_name();
  for (const CLI::App* verb : app->get_subcommands()) command += ' ' + verb->get_name();
  return command + ": " + error.what() + "; see " + command + " --help\n";
}

/// The first word of the command, if it is neither a verb nor a flag.
std::optional<std::string> unknown_verb(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  const std::string word = argv[1];
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_name() == word) return std::nullopt;
  }
  return word;
}

void add_study_options(CLI::App& verb, cli::StudyOptions& study) {
  verb.add_option("study", study.file, "study file (TOML)")->required()->type_name("STUDY.toml");
  verb.add_option("--set", study.overrides, "override a key of the study; repeatable")
      ->type_name("key=value")
      ->allow_extra_args(false);
  verb.add_option("--threads", study.threads, "number of threads (default: all)")
      ->check(CLI::Range(1, 1024));
}

/// "2/10": part 2 of 10.
void parse_shard(const std::string& text, cli::RunSettings& settings) {
  if (text.empty()) return;
  char slash = 0, rest = 0;
  const int read =
      std::sscanf(text.c_str(), "%d%c%d%c", &settings.shard, &slash, &settings.shards, &rest);
  constexpr int kMost = 1'000'000;
  if (read == 3 && slash == '/' && settings.shard >= 1 && settings.shard <= settings.shards &&
      settings.shards <= kMost) {
    return;
  }
  throw core::InputError({"--shard " + text, 0}, "must be k/K with k from 1 to K: 2/10");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("millstudy: studies of milling, in parallel, to HDF5", "millstudy");
  app.set_version_flag("--version", cli::version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 internal error, 2 bad input, 3 done but some points failed,\n"
      "4 interrupted or out of a resource.");

  cli::StudyOptions study;
  CLI::App* plan = app.add_subcommand("plan", "check a study; print points, time and file size");
  add_study_options(*plan, study);
  plan->add_flag("--json", study.json, "print JSON");

  cli::RunSettings settings;
  std::string shard;
  CLI::App* run = app.add_subcommand("run", "compute a study into a result file");
  add_study_options(*run, study);
  run->add_option("-o,--output", settings.output, "result file (default: <study.name>.h5 here)")
      ->type_name("R.h5");
  run->add_flag("--fresh", settings.fresh, "compute again; an existing result is moved aside");
  run->add_flag("--failed", settings.failed, "compute failed points again")->excludes("--fresh");
  run->add_flag("--extend", settings.extend,
                "axes have other values: use the points that are there")
      ->excludes("--fresh")
      ->excludes("--failed");
  run->add_option("--shard", shard, "compute part k of K only, for merge")
      ->type_name("k/K")
      ->excludes("--extend");
  run->add_option("--block-size", settings.block_size, "points per block (default: chosen)")
      ->check(CLI::Range(1, 1'000'000));
  run->add_option("--memory", settings.memory, "most memory to use, as 500MB or 4GB")
      ->transform(CLI::AsSizeValue(true))
      ->type_name("SIZE");
  run->add_option("--max-failures", settings.max_failures, "end early beyond so many failed points")
      ->check(CLI::NonNegativeNumber);
  run->add_option("--disk-wait", settings.disk_patience,
                  "seconds to wait for room on a full disk (default: 600)")
      ->check(CLI::Range(0.0, 1e6));
  run->add_flag("--quiet", settings.quiet, "no progress");
  run->add_flag("--json", study.json, "print the summary as JSON");

  cli::FitOptions fitting;
  CLI::App* fit = app.add_subcommand("fit", "coefficients from measured force traces");
  fit->add_option("fit", fitting.file, "fit file (TOML)")->required()->type_name("FIT.toml");
  fit->add_option("-o,--output", fitting.output, "result file (default: <fit.name>.h5 here)")
      ->type_name("F.h5");
  fit->add_option("--coefficients", fitting.coefficients,
                  "coefficients file (default: beside the result, .coefficients.toml)")
      ->type_name("K.toml");
  fit->add_option("--threads", fitting.threads, "number of threads (default: all)")
      ->check(CLI::Range(1, 1024));
  fit->add_flag("--quiet", fitting.quiet, "no progress");
  fit->add_flag("--json", fitting.json, "print the result as JSON");

  std::string watched;
  CLI::App* status = app.add_subcommand("status", "how far a run is, while it runs or after");
  status->add_option("result", watched, "result file")->required()->type_name("R.h5");
  status->add_flag("--json", study.json, "print JSON");

  std::string merged;
  std::vector<std::string> parts;
  CLI::App* merge = app.add_subcommand("merge", "one result from those of --shard");
  merge->add_option("output", merged, "result file")->required()->type_name("OUT.h5");
  merge->add_option("parts", parts, "results of the parts")->required()->type_name("SHARD.h5");

  cli::SensitivityOptions indices;
  CLI::App* sensitivity = app.add_subcommand(
      "sensitivity", "Sobol' indices: which axes of a saltelli design make a variable vary");
  sensitivity->add_option("result", indices.result, "result file")->required()->type_name("R.h5");
  sensitivity->add_option("--variable", indices.variables, "only this one; repeatable")
      ->allow_extra_args(false);
  sensitivity->add_option("-o,--output", indices.output, "also write a table")->type_name("T.csv");
  sensitivity->add_flag("--json", indices.json, "print JSON");

  cli::ExportOptions table;
  CLI::App* exporting = app.add_subcommand("export", "write a result as a table");
  exporting->add_option("result", table.result, "result file")->required()->type_name("R.h5");
  exporting->add_option("-o,--output", table.output, "table: .csv or .npy")->required();

  exporting->add_option("--point", table.point, "the trace of this point, counted from 0, as .csv")
      ->check(CLI::NonNegativeNumber);

  std::string kind;
  bool markdown = false;
  CLI::App* keys =
      app.add_subcommand("keys", "every key of a study file, by kind, and of a fit file");
  keys->add_option("kind", kind, "one kind only");
  keys->add_flag("--markdown", markdown, "as Markdown tables");
  run->footer("Keys of the study file: millstudy keys");
  plan->footer("Keys of the study file: millstudy keys");

  app.failure_message(usage_fault);
  if (argc < 2) {
    std::fputs(
        "millstudy: give one of plan, run, status, merge, fit, sensitivity, export, keys; see "
        "millstudy --help\n",
        stderr);
    return cli::kBadInput;
  }
  if (const auto word = unknown_verb(app, argc, argv)) {
    std::fprintf(stderr,
                 "millstudy: %s is not one of plan, run, status, merge, fit, sensitivity, export, "
                 "keys; see millstudy --help\n",
                 word->c_str());
    return cli::kBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? cli::kDone : cli::kBadInput;
  }
  cli::open_standard_streams();
  cli::report_full_disk_as_error();
  const int code = guarded([&] {
    if (*plan) return cli::plan(study);
    if (*run) {
      parse_shard(shard, settings);
      return cli::run(study, settings);
    }
    if (*fit) return cli::fit(fitting);
    if (*status) return cli::status(watched, study.json);
    if (*merge) return cli::merge(merged, parts);
    if (*sensitivity) return cli::sensitivity(indices);
    if (*exporting) return cli::export_result(table);
    return cli::print_keys(kind, markdown);
  });
  if (std::fflush(stdout) == 0) return code;
  std::fputs("standard output cannot be written: disk full?\n", stderr);
  return cli::kInterrupted;
}
