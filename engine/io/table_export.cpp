// SPDX-License-Identifier: MIT
#include "io/table_export.h"

#include <cerrno>
#include <cstring>
#include <fmt/core.h>
#include <fstream>

#include "core/error.h"
#include "core/resource_error.h"
#include "io/atomic_file.h"
#include "io/table_format.h"

namespace millstudy::io {
namespace {

using Format = void (*)(const PointTable&, std::ostream&);

Format format_of(const std::string& path) {
  if (path.ends_with(".csv")) return write_csv;
  if (path.ends_with(".npy")) return write_npy;
  throw core::InputError(
      {{core::Place{path, 0}, "is of no known kind: tables are written as .csv or .npy"}});
}

}  // namespace

void export_table(const std::string& result_path, const std::string& output_path) {
  const Format write = format_of(output_path);
  const hdf5::QuietErrors quiet;
  try {
    const PointTable table(result_path);
    AtomicFile target(output_path);
    std::ofstream out(target.temporary_path(), std::ios::binary | std::ios::trunc);
    out.exceptions(std::ios::badbit | std::ios::failbit);
    write(table, out);
    out.close();
    target.commit();
  } catch (const std::ios_base::failure&) {
    const int error = errno;  // of the write that failed: the stream's own text says nothing
    throw core::ResourceError(fmt::format("{}: cannot be written: {}", output_path,
                                          std::strerror(error != 0 ? error : EIO)));
  } catch (const hdf5::Error& error) {
    throw core::InputError({{core::Place{result_path, 0},
                             fmt::format("is no readable result file: {}", error.what())}});
  }
}

}  // namespace millstudy::io
