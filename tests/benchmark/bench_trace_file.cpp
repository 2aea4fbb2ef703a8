// SPDX-License-Identifier: MIT
// Reading traces: text of four columns against std::getline and std::strtod, the usual way, and the
// same numbers from MATLAB and HDF5. Files are in the page cache; rates are bytes of the file.
//
//   bench_trace_file [MEGABYTES [REPETITIONS]]     100 MB and 5 by default; medians are printed
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <matio.h>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

#include "io/hdf5.h"
#include "io/trace_file.h"

namespace {

using namespace millstudy;
using Columns = std::vector<std::vector<double>>;

/// A force of ten kilohertz with noise, as a charge amplifier gives it.
Columns make_columns(std::size_t rows) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 100.0);
  Columns columns(4);
  for (std::size_t i = 0; i < rows; ++i) {
    columns[0].push_back(static_cast<double>(i) * 1e-4);
    for (std::size_t k = 1; k < 4; ++k) columns[k].push_back(noise(random));
  }
  return columns;
}

void write_text(const std::string& path, const Columns& columns, char separator, char decimal) {
  std::FILE* const file = std::fopen(path.c_str(), "w");
  std::fprintf(file, "Time%cFx%cFy%cFz\n", separator, separator, separator);
  char line[128];
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    const int length =
        std::snprintf(line, sizeof line, "%.4f%c%g%c%g%c%g\n", columns[0][i], separator,
                      columns[1][i], separator, columns[2][i], separator, columns[3][i]);
    if (decimal != '.') std::replace(line, line + length, '.', decimal);
    std::fwrite(line, 1, static_cast<std::size_t>(length), file);
  }
  std::fclose(file);
}

void write_matlab(const std::string& path, const Columns& columns) {
  mat_t* const file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  const char* const names[] = {"t", "Fx", "Fy", "Fz"};
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t shape[2] = {1, columns[k].size()};
    std::vector<double> copy = columns[k];
    matvar_t* const variable =
        Mat_VarCreate(names[k], MAT_C_DOUBLE, MAT_T_DOUBLE, 2, shape, copy.data(), 0);
    Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

void write_hdf5(const std::string& path, const Columns& columns) {
  const io::hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                              "create a file");
  const char* const names[] = {"t", "Fx", "Fy", "Fz"};
  for (std::size_t k = 0; k < 4; ++k) {
    const io::Shape shape = {static_cast<std::int64_t>(columns[k].size())};
    const io::hdf5::Handle dataset =
        io::hdf5::create_dataset(file.get(), names[k], H5T_IEEE_F64LE, shape);
    io::hdf5::write_range(dataset.get(), H5T_NATIVE_DOUBLE, shape, 0, shape[0], columns[k].data());
  }
}

/// The baseline.
Columns read_by_strtod(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  Columns columns(4);
  while (std::getline(in, line)) {
    const char* at = line.c_str();
    for (std::vector<double>& column : columns) {
      char* end = nullptr;
      column.push_back(std::strtod(at, &end));
      at = *end == '\0' ? end : end + 1;
    }
  }
  return columns;
}

Columns read_by_us(const std::string& path, const io::TraceSelection& selection) {
  io::TraceFile file = io::read_trace_file(path, selection);
  Columns columns = {std::move(file.channels.time)};
  for (identify::Channel& channel : file.channels.channels) {
    columns.push_back(std::move(channel.samples));
  }
  return columns;
}

/// MB/s, the median of several.
double rate(const std::string& path, int repetitions, const std::function<Columns()>& read,
            const Columns& expected) {
  std::vector<double> seconds;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const Columns columns = read();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (columns != expected) {
      std::fprintf(stderr, "%s: other numbers than the baseline\n", path.c_str());
      std::exit(1);
    }
  }
  std::nth_element(seconds.begin(), seconds.begin() + repetitions / 2, seconds.end());
  return static_cast<double>(std::filesystem::file_size(path)) * 1e-6 / seconds[repetitions / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const double megabytes = argc > 1 ? std::atof(argv[1]) : 100.0;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("millstudy_bench_trace_" + std::to_string(getpid())))
                               .string();
  const Columns columns = make_columns(static_cast<std::size_t>(megabytes * 1e6 / 34.0));
  const io::TraceSelection by_name{
      .variables = {{"time", "t"}, {"Fx", "Fx"}, {"Fy", "Fy"}, {"Fz", "Fz"}}};

  write_text(path, columns, ',', '.');
  std::printf("%.1f MB of text, 4 columns\n",
              static_cast<double>(std::filesystem::file_size(path)) * 1e-6);
  const Columns printed = read_by_strtod(path);
  const double baseline = rate(
      path, repetitions, [&] { return read_by_strtod(path); }, printed);
  const auto report = [&](const char* name, double got) {
    std::printf("%-34s %7.0f MB/s  %5.2f x getline and strtod\n", name, got, got / baseline);
  };
  report("getline and strtod", baseline);
  const auto ours = [&](const io::TraceSelection& selection, const Columns& expected) {
    return rate(
        path, repetitions, [&] { return read_by_us(path, selection); }, expected);
  };
  report("commas, points", ours({}, printed));
  report("commas, points, 2 of 4 columns",
         ours({.variables = {{"Fx", "Fx"}}}, {printed[0], printed[1]}));
  write_text(path, columns, ';', ',');
  report("semicolons, decimal commas", ours({}, printed));
  write_matlab(path, columns);
  report("MATLAB 5", ours(by_name, columns));
  write_hdf5(path, columns);
  report("HDF5", ours(by_name, columns));
  std::filesystem::remove(path);
}
