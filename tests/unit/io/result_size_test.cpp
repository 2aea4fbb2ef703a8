// SPDX-License-Identifier: MIT
#include "io/result_size.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <ostream>

#include "io/result_writer.h"
#include "io/sample_results.h"

namespace millstudy::io {
namespace {

using sample::Design;

struct Case {
  const char* name;
  std::vector<std::int64_t> shape;
  Design design;
  bool traces;

  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }
};

std::string name_of(const testing::TestParamInfo<Case>& one) {
  return one.param.name;
}

class ResultSize : public testing::TestWithParam<Case> {
 protected:
  sweep::Layout layout() const {
    return sample::layout(GetParam().shape, GetParam().design, GetParam().traces);
  }
};

double written_bytes(const sweep::Layout& layout) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string path = std::string("result_size_") + test.name() + ".h5";
  std::replace(path.begin(), path.end(), '/', '_');
  path = testing::TempDir() + "/" + path;
  const auto writer = make_result_writer(path, layout);
  writer->write(sample::block(layout, 0, layout.points()));
  writer->finish({});
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::remove(path);
  return size;
}

double samples_of(const std::vector<sweep::Block>& blocks) {
  double samples = 0.0;
  for (const sweep::Block& block : blocks) {
    for (std::size_t i = 0; i < block.traces.size(); ++i) {
      if (block.status[i] == sweep::Status::ok) {
        samples += static_cast<double>(block.traces[i].time.size());
      }
    }
  }
  return samples;
}

TEST_P(ResultSize, IsExactOfAllPoints) {
  const sweep::Layout all = layout();
  std::vector<sweep::Block> blocks = {sample::block(all, 0, all.points())};
  const double samples = samples_of(blocks);
  EXPECT_DOUBLE_EQ(expected_result_bytes(all, blocks, samples), written_bytes(all));
}

TEST_P(ResultSize, IsCloseOfSomePoints) {
  const sweep::Layout all = layout();
  const std::int64_t part = std::max<std::int64_t>(1, all.points() / 80);
  std::vector<sweep::Block> blocks;
  for (std::int64_t i = 9; i >= 0; --i) {
    const std::int64_t first = i * all.points() / 10;
    blocks.push_back(sample::block(all, first, std::min(part, all.points() - first)));
  }
  const double samples =
      samples_of(blocks) * static_cast<double>(all.points()) / (10.0 * static_cast<double>(part));
  const double ratio = expected_result_bytes(all, blocks, samples) / written_bytes(all);
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_NEAR(ratio, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, ResultSize,
                         testing::Values(Case{"line", {40}, Design::grid, false},
                                         Case{"small_traces", {3, 7, 11}, Design::grid, true},
                                         Case{"traces", {3, 200, 300}, Design::grid, true},
                                         Case{"grid", {2, 70'000}, Design::grid, false},
                                         Case{"zip", {150'000}, Design::zip, true}),
                         name_of);

}  // namespace
}  // namespace millstudy::io
