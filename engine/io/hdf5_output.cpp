// SPDX-License-Identifier: MIT
#include "io/hdf5_output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <system_error>
#include <unistd.h>

#include "io/write_behind.h"

namespace millstudy::io::hdf5 {
namespace {

/// What HDF5 holds of an open file; its own part comes first.
struct DriverFile {
  H5FD_t common{};
  Output* output = nullptr;
  haddr_t end_allocated = 0;
  haddr_t end_written = 0;
  std::optional<WriteBehind> behind;
};

constexpr haddr_t kLargestAddress = (haddr_t{1} << 63) - 1;

DriverFile& mine(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& mine(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

herr_t failed(Output& output, int error, hid_t minor) {
  output.error = error;
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, minor, "%s",
           std::strerror(error));
  return -1;
}

H5FD_t* open(const char* /*name*/, unsigned flags, hid_t access, haddr_t /*largest*/) {
  Output* output = *static_cast<Output* const*>(H5Pget_driver_info(access));
  if ((flags & H5F_ACC_TRUNC) != 0 && ::ftruncate(output->fd, 0) != 0) {
    failed(*output, errno, H5E_CANTOPENFILE);
    return nullptr;
  }
  try {
    auto file = std::make_unique<DriverFile>();
    file->output = output;
    file->behind.emplace(output->fd);
    return &file.release()->common;
  } catch (const std::system_error& no_thread) {
    failed(*output, no_thread.code().value(), H5E_CANTOPENFILE);
  } catch (const std::bad_alloc&) {  // nothing may be thrown through the library
    failed(*output, ENOMEM, H5E_CANTOPENFILE);
  }
  return nullptr;
}

/// Waits for all that was to be written.
void settle(DriverFile& self) {
  const int error = self.behind->wait();
  if (self.output->error == 0) self.output->error = error;
}

herr_t close(H5FD_t* file) {
  settle(mine(file));
  delete &mine(file);
  return 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return mine(file).end_allocated;
}

herr_t set_allocated(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t end) {
  mine(file).end_allocated = end;
  return 0;
}

haddr_t written(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return mine(file).end_written;
}

/// What lies beyond the end of the file reads as zero.
herr_t read(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address,
            std::size_t size, void* buffer) {
  DriverFile& self = mine(file);
  settle(self);
  char* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got = ::pread(self.output->fd, to, size, static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return failed(*self.output, errno, H5E_READERROR);
    if (got == 0) break;
    to += got;
    address += static_cast<haddr_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  std::fill_n(to, size, '\0');
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address,
             std::size_t size, const void* buffer) {
  DriverFile& self = mine(file);
  if (self.output->error != 0) return 0;
  int error = ENOMEM;
  try {
    error = self.behind->write(address, {static_cast<const char*>(buffer), size});
  } catch (const std::bad_alloc&) {  // nothing may be thrown through the library
  }
  if (error != 0) return failed(*self.output, error, H5E_WRITEERROR);
  self.end_written = std::max(self.end_written, address + size);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  DriverFile& self = mine(file);
  settle(self);
  if (self.output->error != 0 || self.end_allocated == self.end_written) return 0;
  if (::ftruncate(self.output->fd, static_cast<off_t>(self.end_allocated)) != 0) {
    return failed(*self.output, errno, H5E_SEEKERROR);
  }
  self.end_written = self.end_allocated;
  return 0;
}

hid_t register_driver() {
  static const H5FD_class_t driver = [] {
    H5FD_class_t made{};
    made.name = "millstudy";
    made.maxaddr = kLargestAddress;
    made.fc_degree = H5F_CLOSE_WEAK;
    made.fapl_size = sizeof(Output*);
    made.open = open;
    made.close = close;
    made.query = query;
    made.get_eoa = allocated;
    made.set_eoa = set_allocated;
    made.get_eof = written;
    made.read = read;
    made.write = write;
    made.truncate = truncate;
    const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(map), std::end(map), made.fl_map);
    return made;
  }();
  return check(H5FDregister(&driver), "register its driver");
}

}  // namespace

Handle create_file(Output& output) {
  static const hid_t driver = register_driver();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), "make a property list");
  constexpr unsigned kOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
  check(H5Pset_link_creation_order(creation.get(), kOrder), "track the order of variables");
  check(H5Pset_attr_creation_order(creation.get(), kOrder), "track the order of attributes");
  check(H5Pset_obj_track_times(creation.get(), false), "leave out times");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), "make a property list");
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "choose a format");
  Output* const info = &output;
  check(H5Pset_driver(access.get(), driver, &info), "choose its driver");
  return {H5Fcreate("result", H5F_ACC_TRUNC, creation.get(), access.get()), "create the file"};
}

}  // namespace millstudy::io::hdf5
