// SPDX-License-Identifier: MIT
#include "study/share_key.h"

namespace millstudy::study {
namespace {

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string share_key(std::initializer_list<std::span<const Key>> sections, const Case& point,
                      std::initializer_list<double> quantities) {
  std::string bytes;
  for (const std::span<const Key> section : sections) {
    for (const Key& key : section) {
      if (!key.field) continue;
      std::visit(
          [&]<class T>(const T* field) {
            if constexpr (std::is_same_v<T, CurvePtr>) {
              append_bytes(bytes, field->get());  // one object as long as the study lives
            } else if constexpr (std::is_same_v<T, std::optional<double>>) {
              append_bytes(bytes, field->has_value());
              append_bytes(bytes, field->value_or(0.0));
            } else if constexpr (std::is_same_v<T, std::optional<Milling>>) {
              append_bytes(bytes, field->has_value());
              append_bytes(bytes, field->value_or(Milling::slot));
            } else {
              append_bytes(bytes, *field);
            }
          },
          key.field(const_cast<Case&>(point)));  // only read
    }
  }
  for (const double quantity : quantities) append_bytes(bytes, quantity);
  return bytes;
}

}  // namespace millstudy::study
