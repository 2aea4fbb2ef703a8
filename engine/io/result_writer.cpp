// SPDX-License-Identifier: MIT
#include "io/result_writer.h"

#include <cstring>
#include <fmt/core.h>
#include <optional>
#include <stdexcept>

#include "core/resource_error.h"
#include "io/atomic_file.h"
#include "io/result_content.h"

namespace millstudy::io {
namespace {

class ResultWriter final : public ResultSink {
 public:
  ResultWriter(const std::string& path, const sweep::Layout& layout)
      : target_(path), points_(layout.points()) {
    guarded([&] { content_.emplace(output_, layout); });
  }

  ~ResultWriter() override { close(); }

  void write(const sweep::Block& block) override {
    begin(block.first);
    guarded([&] { content_->append(block); });
    next_point_ += block.count;
  }

  void write(const PackedPoints& points) override {
    begin(points.first);
    guarded([&] { content_->append(points); });
    next_point_ += points.count;
  }

  const Shape& chunk() const override { return content_->variables().chunk; }

  void leave_out(std::int64_t first, std::int64_t count) override {
    begin(first);
    guarded([&] { content_->leave_out(count); });
    next_point_ += count;
  }

  void finish(const std::vector<sweep::Attribute>& attributes) override {
    if (next_point_ != points_) throw std::logic_error("a result needs all its points");
    guarded([&] { content_->finish(attributes); });
    close();
    if (output_.error != 0) fail(std::strerror(output_.error));
    target_.commit();
  }

 private:
  void begin(std::int64_t first) const {
    if (first != next_point_) throw std::logic_error("blocks must come in order");
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
    content_.reset();
  }

  AtomicFile target_;
  hdf5::Output output_{target_.descriptor()};
  std::int64_t points_;
  std::int64_t next_point_ = 0;
  std::optional<ResultContent> content_;
};

}  // namespace

std::unique_ptr<ResultSink> make_result_writer(const std::string& path,
                                               const sweep::Layout& layout) {
  return std::make_unique<ResultWriter>(path, layout);
}

}  // namespace millstudy::io
