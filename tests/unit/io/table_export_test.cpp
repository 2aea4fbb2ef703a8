// SPDX-License-Identifier: MIT
#include "io/table_export.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "io/result_writer.h"
#include "io/sample_results.h"

namespace millstudy::io {
namespace {

namespace fs = std::filesystem;
using sample::Design;

class TableExport : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "/export_" +
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    result_ = folder_ + "/r.h5";
    table_ = folder_ + "/r.csv";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const sweep::Layout& layout) const {
    const auto writer = make_result_writer(result_, layout);
    writer->write(sample::block(layout, 0, layout.points()));
    writer->finish({});
  }

  std::string folder_;
  std::string result_;
  std::string table_;
};

/// Fields of the lines of a CSV file.
std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> fields(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"' && inside && i + 1 < line.size() && line[i + 1] == '"') {
        fields.back() += line[++i];
      } else if (line[i] == '"') {
        inside = !inside;
      } else if (line[i] == ',' && !inside) {
        fields.emplace_back();
      } else {
        fields.back() += line[i];
      }
    }
    rows.push_back(fields);
  }
  return rows;
}

double number(const std::string& text) {
  double value = std::nan("");
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool export_refused(const std::string& result, const std::string& table) {
  try {
    export_table(result, table);
    return false;
  } catch (const core::InputError&) {
    return true;
  }
}

TEST_F(TableExport, GivesTheSameBitsBackPointByPoint) {
  const sweep::Layout layout = sample::layout({3, 4, 20000}, Design::grid, false);
  write(layout);
  export_table(result_, table_);
  const auto rows = read_csv(table_);
  ASSERT_EQ(rows.size(), 240001u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{
                         "method", "axis_1 [mm/min]", "axis_2 [mm/min]", "force_resultant_mean [N]",
                         "feed_fluctuation_max [percent]", "steps", "status", "failure"}));
  for (std::int64_t i = 0; i < layout.points(); ++i) {
    const std::vector<std::string>& row = rows[static_cast<std::size_t>(i) + 1];
    ASSERT_EQ(row.size(), 8u);
    ASSERT_EQ(row[0], (std::vector<std::string>{"taylor1", "taylor2", "newton"}[i / 80000]));
    ASSERT_EQ(number(row[1]), 600.0 + 100.0 * static_cast<double>(i / 20000 % 4));
    ASSERT_EQ(number(row[2]), 600.0 + 100.0 * static_cast<double>(i % 20000));
    const bool ok = sample::status(i) == sweep::Status::ok;
    for (std::size_t c = 0; c < 3; ++c) {
      if (ok) {
        ASSERT_EQ(number(row[3 + c]), sample::value(c, i));
      }
      if (!ok) {
        ASSERT_EQ(row[3 + c], "");
      }
    }
    ASSERT_EQ(row[6] == "ok", ok);
    ASSERT_EQ(row[7], sample::failure(i));
  }
}

TEST_F(TableExport, TakesEveryDesign) {
  for (const auto& layout :
       {sample::layout({}, Design::grid, true), sample::layout({1}, Design::grid, false),
        sample::layout({100}, Design::zip, true), sample::layout({80000}, Design::zip, false)}) {
    write(layout);
    export_table(result_, table_);
    export_table(result_, folder_ + "/r.npy");
    EXPECT_EQ(read_csv(table_).size(), static_cast<std::size_t>(layout.points()) + 1);
  }
}

TEST_F(TableExport, RefusesOtherSuffixesAndInputs) {
  write(sample::layout({5}, Design::grid, false));
  EXPECT_THROW(export_table(result_, folder_ + "/r.xlsx"), core::InputError);
  EXPECT_THROW(export_table(folder_ + "/none.h5", table_), core::InputError);
  EXPECT_THROW(export_table(result_, folder_ + "/none/r.csv"), core::InputError);
  EXPECT_THROW(export_table(folder_, table_), core::InputError);
  std::ofstream(result_) << "no HDF5";
  EXPECT_THROW(export_table(result_, table_), core::InputError);
  EXPECT_FALSE(fs::exists(table_));
}

TEST_F(TableExport, RefusesTruncatedFiles) {
  write(sample::layout({3, 40}, Design::grid, false));
  for (auto size = static_cast<std::int64_t>(fs::file_size(result_)) - 1; size >= 0; size -= 61) {
    fs::resize_file(result_, static_cast<std::uintmax_t>(size));
    EXPECT_THROW(export_table(result_, table_), core::InputError) << size;
  }
}

/// Exit code of an export in a process of its own; negative if that died. HDF5 1.10 keeps
/// identifiers of damaged objects that it failed to close, so one process takes one such file.
int export_apart(const std::string& result, const std::string& table) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(20);
    ::_exit(export_refused(result, table) ? 1 : 0);
  }
  int outcome = -1;
  ::waitpid(child, &outcome, 0);
  return WIFEXITED(outcome) ? WEXITSTATUS(outcome) : -1;
}

TEST_F(TableExport, SurvivesFilesWithAWrongBit) {
  // HDF5 1.10 itself reads outside its buffers for 0.2 % of the bits of so small a file: those of
  // the heap of texts and references, which has no checksum. The rest must end well.
  write(sample::layout({3, 40}, Design::grid, false));
  std::ifstream file(result_, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::mt19937 random(11);
  constexpr int kTrials = 200;
  int died = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string bad = good;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, bad.size() - 1)(random);
    bad[at] = static_cast<char>(bad[at] ^ (1 << (trial % 8)));
    std::ofstream(result_, std::ios::binary | std::ios::trunc) << bad;
    if (export_apart(result_, table_) < 0) ++died;
  }
  EXPECT_LE(died, kTrials / 50);
}

}  // namespace
}  // namespace millstudy::io
