// SPDX-License-Identifier: MIT
#include "study/share_key.h"

#include <memory>
#include <optional>
#include <vector>

namespace millstudy::study {
namespace {

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// append() adds what a field of the case holds.

template <class T>
void append(std::string& bytes, const T* field) {
  append_bytes(bytes, *field);
}
template <class T>
void append(std::string& bytes, const std::optional<T>* field) {
  append_bytes(bytes, field->has_value());
  append_bytes(bytes, field->value_or(T{}));
}
/// One object as long as the study lives.
template <class T>
void append(std::string& bytes, const std::shared_ptr<const T>* field) {
  append_bytes(bytes, field->get());
}
void append(std::string& bytes, const std::vector<double>* field) {
  append_bytes(bytes, field->size());
  for (const double number : *field) append_bytes(bytes, number);
}
void append(std::string& bytes, NumberOrNumbers field) {
  append(bytes, field.number);
  append(bytes, field.numbers);
}
void append(std::string& bytes, PartsOfTurn field) {
  append(bytes, field.angles);
}

}  // namespace

std::string share_key(std::initializer_list<std::span<const Key>> sections, const Case& point,
                      std::initializer_list<double> quantities) {
  std::string bytes;
  for (const std::span<const Key> section : sections) {
    for (const Key& key : section) {
      if (!key.field) continue;
      std::visit([&](auto field) { append(bytes, field); },
                 key.field(const_cast<Case&>(point)));  // only read
    }
  }
  for (const double quantity : quantities) append_bytes(bytes, quantity);
  return bytes;
}

}  // namespace millstudy::study
