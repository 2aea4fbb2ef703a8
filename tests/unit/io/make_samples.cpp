// SPDX-License-Identifier: MIT
// make_samples FOLDER: writes results of every shape, for check_result.py.
// make_samples FOLDER POINTS COLUMNS: writes one of that size (a multiple of 1000), and prints
// time, size and memory.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <sys/resource.h>

#include "io/result_writer.h"
#include "io/sample_results.h"
#include "io/table_export.h"

namespace {

using namespace millstudy;

void write(const std::string& path, const sweep::Layout& layout, std::int64_t block_size,
           const std::vector<sweep::Attribute>& late) {
  const auto writer = io::make_result_writer(path, layout);
  for (std::int64_t first = 0; first < layout.points(); first += block_size) {
    const std::int64_t count = std::min(block_size, layout.points() - first);
    writer->write(io::sample::block(layout, first, count));
  }
  writer->finish(late);
}

void write_samples(const std::string& folder) {
  using io::sample::Design;
  const std::vector<sweep::Attribute> late = {{"points_failed", std::int64_t{3}},
                                              {"wall_time_s", 1.5},
                                              {"study", std::string(300000, 'x') + "end"},
                                              {"host", std::string()}};
  write(folder + "/scalar.h5", io::sample::layout({}, Design::grid, false), 1, late);
  write(folder + "/grid1.h5", io::sample::layout({40}, Design::grid, false), 7, late);
  write(folder + "/grid2.h5", io::sample::layout({3, 50}, Design::grid, false), 7, late);
  write(folder + "/grid3.h5", io::sample::layout({4, 10, 12}, Design::grid, true), 64, late);
  write(folder + "/grid4.h5", io::sample::layout({5, 3, 6, 2}, Design::grid, false), 11, late);
  write(folder + "/same.h5", io::sample::layout({12, 12}, Design::grid, true), 5, late);
  write(folder + "/zip.h5", io::sample::layout({100}, Design::zip, true), 13, late);
  for (const std::string name : {"scalar", "grid2", "zip"}) {
    io::export_table(folder + "/" + name + ".h5", folder + "/" + name + ".csv");
    io::export_table(folder + "/" + name + ".h5", folder + "/" + name + ".npy");
  }
}

void write_large(const std::string& folder, std::int64_t points, std::size_t columns) {
  sweep::Layout layout = io::sample::layout({points / 1000, 1000}, io::sample::Design::grid, false);
  layout.columns.clear();
  for (std::size_t c = 0; c < columns; ++c) {
    layout.columns.push_back({"column_" + std::to_string(c), "N", "a column"});
  }
  const std::string path = folder + "/large.h5";
  sweep::Block block = io::sample::block(layout, 0, 1000);
  std::chrono::duration<double> spent{};
  const auto timed = [&](const auto& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    spent += std::chrono::steady_clock::now() - start;
  };
  const auto writer = io::make_result_writer(path, layout);
  for (std::int64_t first = 0; first < points; first += block.count) {
    block.first = first;
    block.count = std::min(block.count, points - first);
    for (std::size_t i = 0; i < block.values.size(); ++i) {
      const double x = static_cast<double>(first) + static_cast<double>(i);
      block.values[i] = 300.0 + std::sin(1e-3 * x) * std::cos(0.1 * x);
    }
    timed([&] { writer->write(block); });
  }
  timed([&] { writer->finish({}); });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  const double raw = 8.0 * static_cast<double>(points) * static_cast<double>(columns);
  std::cout << points << " points x " << columns << ": " << spent.count() << " s, "
            << raw / spent.count() * 1e-6 << " MB/s, ratio " << raw / size << ", peak "
            << usage.ru_maxrss / 1024 << " MB\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2) write_samples(argv[1]);
  if (argc == 4) {
    write_large(argv[1], std::atoll(argv[2]), static_cast<std::size_t>(std::atoll(argv[3])));
  }
  return argc == 2 || argc == 4 ? 0 : 2;
}
