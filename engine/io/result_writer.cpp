// SPDX-License-Identifier: MIT
#include "io/result_writer.h"

#include <cstring>
#include <fmt/core.h>
#include <optional>
#include <stdexcept>
#include <variant>

#include "core/error.h"
#include "core/resource_error.h"
#include "io/atomic_file.h"
#include "io/failure_table.h"
#include "io/hdf5_output.h"
#include "io/result_variables.h"

namespace millstudy::io {
namespace {

void write_attributes(hid_t file, const std::vector<sweep::Attribute>& attributes) {
  for (const auto& [name, value] : attributes) {
    std::visit([&, &key = name](const auto& v) { hdf5::write_attribute(file, key, v); }, value);
  }
}

class ResultWriter final : public sweep::Sink {
 public:
  ResultWriter(const std::string& path, const sweep::Layout& layout)
      : target_(path), points_(layout.points()) {
    if (layout.shape.size() > H5S_MAX_RANK) {
      throw core::InputError(fmt::format("a result file has at most {} dimensions, not {}",
                                         H5S_MAX_RANK, layout.shape.size()));
    }
    guarded([&] {
      file_ = hdf5::create_file(output_);
      hdf5::write_attribute(file_.get(), "Conventions", std::string("CF-1.8"));
      write_attributes(file_.get(), layout.attributes);
      variables_.emplace(create_variables(file_.get(), layout));
    });
  }

  ~ResultWriter() override { close(); }

  void write(const sweep::Block& block) override {
    if (block.first != next_point_) throw std::logic_error("blocks must come in order");
    guarded([&] { append(block); });
    next_point_ += block.count;
  }

  void finish(const std::vector<sweep::Attribute>& attributes) override {
    if (next_point_ != points_) throw std::logic_error("a result needs all its points");
    guarded([&] {
      for (ChunkStream<double>& column : variables_->columns) column.flush();
      variables_->status.flush();
      variables_->failure_code.flush();
      for (TraceVariables& traces : variables_->traces) traces.flush();
      write_failures(file_.get(), failures_.reasons());
      write_attributes(file_.get(), attributes);
      hdf5::check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), "flush the file");
    });
    close();
    if (output_.error != 0) fail(std::strerror(output_.error));
    target_.commit();
  }

 private:
  void append(const sweep::Block& block) {
    const auto count = static_cast<std::size_t>(block.count);
    for (std::size_t c = 0; c < variables_->columns.size(); ++c) {
      variables_->columns[c].append({block.values.data() + c * count, count});
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto status = static_cast<std::int8_t>(block.status[i]);
      const std::int32_t code = failures_.code(block.failures[i]);
      variables_->status.append({&status, 1});
      variables_->failure_code.append({&code, 1});
    }
    for (TraceVariables& traces : variables_->traces) traces.append(block);
  }

  /// Whatever HDF5 cannot do with our own new file is the disk's fault, and final.
  template <class Action>
  void guarded(const Action& action) {
    const hdf5::QuietErrors quiet;
    try {
      action();
    } catch (const hdf5::Error& error) {
      close();
      fail(output_.error != 0 ? std::strerror(output_.error) : error.what());
    }
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw core::ResourceError(fmt::format("{}: cannot be written: {}", target_.path(), why));
  }

  void close() noexcept {
    const hdf5::QuietErrors quiet;
    variables_.reset();
    file_.close();
  }

  AtomicFile target_;
  hdf5::Output output_{target_.descriptor()};
  std::int64_t points_;
  std::int64_t next_point_ = 0;
  FailureTable failures_;
  hdf5::Handle file_;
  std::optional<ResultVariables> variables_;
};

}  // namespace

std::unique_ptr<sweep::Sink> make_result_writer(const std::string& path,
                                                const sweep::Layout& layout) {
  return std::make_unique<ResultWriter>(path, layout);
}

}  // namespace millstudy::io
