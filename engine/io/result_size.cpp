// SPDX-License-Identifier: MIT
#include "io/result_size.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/resource_error.h"
#include "io/result_content.h"
#include "io/row_major.h"

namespace millstudy::io {
namespace {

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : output_{::memfd_create("result", MFD_CLOEXEC)} {
    if (output_.fd >= 0) return;
    throw core::ResourceError(std::string("no file in memory: ") + std::strerror(errno));
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(output_.fd); }

  hdf5::Output& output() { return output_; }
  double bytes() const {
    struct stat status {};
    return ::fstat(output_.fd, &status) == 0 ? static_cast<double>(status.st_size) : 0.0;
  }

 private:
  hdf5::Output output_;
};

/// Points with the padding of chunks that reach beyond the end.
double padded_points(const Shape& shape, const Shape& chunk) {
  double points = 1.0;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    const std::int64_t chunks = (shape[d] + chunk[d] - 1) / chunk[d];
    points *= static_cast<double>(chunks * chunk[d]);
  }
  return points;
}

/// A last chunk that is mostly empty is compressed.
double padded_samples(double samples) {
  constexpr auto kChunk = static_cast<double>(kChunkElements);
  const double rest = std::fmod(samples, kChunk);
  return 2.0 * rest < kChunk ? samples : samples - rest + kChunk;
}

/// How many values a variable has in the file of some points and in that of all, how many of the
/// latter with the padding of chunks, and in a chunk.
struct Extent {
  double written;
  double all;
  double padded;
  double chunk;
};

/// Adds up what variables take in the file of some points, and would take in that of all.
class Scaling {
 public:
  /// @param repetitive  gzip pays, as ChunkStream decides it
  template <class T>
  void add(const ChunkStream<T>& stream, const Extent& extent, bool repetitive) {
    constexpr double kOfFill = 1.0 / 227.0;  // what gzip makes of equal bytes, measured
    const auto bytes = static_cast<double>(H5Dget_storage_size(stream.dataset()));
    stored_ += bytes;
    const double plain = extent.padded * sizeof(T);
    if (extent.written == extent.all || (bytes == 0.0 && extent.written > 0.0)) {
      expected_ += bytes;
    } else if (repetitive && extent.written > 0.0) {
      const double unused = extent.chunk - std::fmod(extent.written, extent.chunk);
      const double net = std::max(0.0, bytes - unused * sizeof(T) * kOfFill);
      expected_ += std::min(plain, net * extent.all / extent.written);
    } else {
      expected_ += plain;
    }
  }

  /// Of all points, beyond those that are in the file.
  double growth() const { return expected_ - stored_; }

 private:
  double stored_ = 0.0;
  double expected_ = 0.0;
};

/// Values of a column.
std::vector<double> some_values(const std::vector<sweep::Block>& blocks, std::size_t column) {
  std::vector<double> values;
  for (const sweep::Block& block : blocks) {
    const double* const begin =
        block.values.data() + column * static_cast<std::size_t>(block.count);
    values.insert(values.end(), begin, begin + block.count);
  }
  return values;
}

/// Values of a part of the traces.
std::vector<float> some_samples(const std::vector<sweep::Block>& blocks,
                                std::vector<float> sweep::Trace::*part) {
  std::vector<float> samples;
  for (const sweep::Block& block : blocks) {
    for (const sweep::Trace& trace : block.traces) {
      samples.insert(samples.end(), (trace.*part).begin(), (trace.*part).end());
    }
  }
  return samples;
}

/// As ChunkStream decides it.
template <class T>
bool gzip_pays(const ChunkStream<T>& stream, const std::vector<T>& values) {
  return is_repetitive(std::span<const T>(values), stream.fill());
}

/// Writes what was measured; returns what the file of all points takes beyond it.
double write_measured(hdf5::Output& output, const sweep::Layout& layout,
                      const std::vector<sweep::Block>& measured, double trace_samples) {
  Scaling scaling;
  ResultContent content(output, layout);
  const Shape chunk = row_major_chunk(layout.shape, kChunkElements);
  Extent points = {0.0, static_cast<double>(layout.points()), padded_points(layout.shape, chunk),
                   static_cast<double>(element_count(chunk))};
  for (const sweep::Block& block : measured) {
    content.append(block);
    points.written += static_cast<double>(block.count);
  }
  content.finish({});
  const ResultVariables& variables = content.variables();
  for (std::size_t c = 0; c < variables.columns.size(); ++c) {
    const ChunkStream<double>& column = variables.columns[c];
    scaling.add(column, points, gzip_pays(column, some_values(measured, c)));
  }
  scaling.add(variables.status, points, true);
  scaling.add(variables.failure_code, points, true);
  for (const TraceVariables& traces : variables.traces) {
    scaling.add(traces.start, points, false);
    scaling.add(traces.count, points, true);
    const Extent samples = {static_cast<double>(traces.written), trace_samples,
                            padded_samples(trace_samples), static_cast<double>(kChunkElements)};
    for (std::size_t k = 0; k < kTraceChannels.size(); ++k) {
      const std::vector<float> some = some_samples(measured, kTraceChannels[k].samples);
      scaling.add(traces.samples[k], samples, gzip_pays(traces.samples[k], some));
    }
  }
  return scaling.growth();
}

}  // namespace

double expected_result_bytes(const sweep::Layout& layout, std::vector<sweep::Block> measured,
                             double trace_samples) {
  std::sort(measured.begin(), measured.end(),
            [](const sweep::Block& a, const sweep::Block& b) { return a.first < b.first; });
  const hdf5::QuietErrors quiet;
  MemoryFile file;
  const auto fail = [](const char* why) -> void {
    throw core::ResourceError(std::string("a file in memory cannot be written: ") + why);
  };
  double growth = 0.0;
  try {
    growth = write_measured(file.output(), layout, measured, trace_samples);
  } catch (const hdf5::Error& error) {
    fail(error.what());
  }
  if (file.output().error != 0) fail(std::strerror(file.output().error));
  return file.bytes() + growth;
}

}  // namespace millstudy::io
