// SPDX-License-Identifier: MIT
#include "io/toml_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <functional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/toml_hint.h"
#include "io/toml_scan.h"

namespace {
/// Thrown where toml++ 3.3 takes for granted what some text does not hold: "[1.0, }".
struct UnexpectedCharacter {};
constexpr void take_for_granted(bool held) {
  if (!held) throw UnexpectedCharacter{};
}
}  // namespace

// toml++ asserts such things, which would abort; with NDEBUG it even tells the compiler that they
// hold, and the behaviour is undefined.
#undef NDEBUG
#define TOML_ASSERT(expr) take_for_granted(static_cast<bool>(expr))
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 64
#include <toml++/toml.h>

namespace millstudy::io {
namespace {

using core::InputError;
using core::Place;
using core::Value;

constexpr std::size_t kLargestFile = 8u << 20;
constexpr int kMostKeyParts = 16;

/// Owns a file descriptor.
struct Descriptor {
  int fd;
  explicit Descriptor(int descriptor) : fd(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

/// True if the text is UTF-8 (RFC 3629, without checking for the rarer overlong forms).
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    if (lead < 0x80) continue;
    if (lead < 0xc2 || lead > 0xf4) return false;
    for (int rest = lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3; rest > 0; --rest, ++i) {
      if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return false;
    }
  }
  return true;
}

/// The parser names no useful line for these.
void check_encoding(std::string_view text, const std::string& name) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!is_utf8(text.substr(begin, end - begin))) {
      throw InputError({{Place{name, line}, "is not UTF-8 text"}});
    }
    begin = end + 1;
  }
}

/// Turns the parser's tree into ours; faults are collected, not thrown one by one.
class Converter {
 public:
  explicit Converter(const std::string& name) : name_(name) {}

  Value convert(const toml::node& node, int line_of_key) {
    const auto own = static_cast<int>(node.source().begin.line);
    const Place place{name_, own > 0 ? own : line_of_key};
    if (const auto* table = node.as_table()) return {convert_table(*table, place.line), place};
    if (const auto* array = node.as_array()) return {convert_array(*array, place.line), place};
    if (const auto* text = node.as_string()) return {text->get(), place};
    if (const auto* integer = node.as_integer()) return {std::int64_t{integer->get()}, place};
    if (const auto* real = node.as_floating_point()) return {real->get(), place};
    if (const auto* flag = node.as_boolean()) return {flag->get(), place};
    faults_.push_back({place, "dates and times are not supported; put a text in quotes"});
    return {false, place};
  }

  const std::vector<core::Fault>& faults() const { return faults_; }

 private:
  /// toml++ keeps members sorted by name; the order of the file is that of the keys' positions.
  Value::Table convert_table(const toml::table& table, int line) {
    std::vector<std::pair<toml::source_position, std::pair<const toml::key*, const toml::node*>>>
        ordered;
    for (const auto& [key, node] : table) {
      ordered.push_back({key.source().begin, {&key, &node}});
    }
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Value::Table result;
    result.reserve(ordered.size());
    for (const auto& [position, member] : ordered) {
      const int key_line = position.line > 0 ? static_cast<int>(position.line) : line;
      result.push_back({std::string(member.first->str()), convert(*member.second, key_line)});
    }
    return result;
  }

  Value::Array convert_array(const toml::array& array, int line) {
    Value::Array result;
    result.reserve(array.size());
    for (const toml::node& node : array) result.push_back(convert(node, line));
    return result;
  }

  std::string name_;
  std::vector<core::Fault> faults_;
};

/// True if toml++ cannot go on and has no error for it.
bool stumbles(std::string_view text) {
  try {
    const toml::parse_result parsed = toml::parse(text);
    return false;
  } catch (const UnexpectedCharacter&) {
    return true;
  }
}

/// The line where toml++ stumbles, by halving: it reads from the start, so every text that is cut
/// after this line makes it stumble, and none that is cut before.
int line_of_stumble(std::string_view text) {
  std::vector<std::size_t> ends;  // of the lines
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
    ends.push_back(at);
  }
  const auto stumbles_at = [&](std::size_t end) { return stumbles(text.substr(0, end)); };
  return static_cast<int>(std::ranges::partition_point(ends, std::not_fn(stumbles_at)) -
                          ends.begin()) +
         1;
}

toml::parse_result parse_or_refuse(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text);
  } catch (const UnexpectedCharacter&) {
    throw InputError({{Place{name, line_of_stumble(text)},
                       "a character that cannot stand there; names of keys are letters a to z, "
                       "digits, _ and -"}});
  }
}

}  // namespace

std::string read_text(const std::string& path) {
  // O_NONBLOCK: opening a FIFO that nobody writes must not wait for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.fd < 0)
    throw InputError({path, 0}, fmt::format("cannot be read: {}", std::strerror(errno)));
  struct stat status {};
  if (::fstat(file.fd, &status) != 0) throw InputError({path, 0}, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw InputError({path, 0}, "is a folder, not a file");
  if (!S_ISREG(status.st_mode)) throw InputError({path, 0}, "is not a regular file");
  std::string text;
  std::vector<char> buffer(1u << 16);
  for (;;) {
    const ssize_t got = ::read(file.fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw InputError({path, 0}, fmt::format("cannot be read: {}", std::strerror(errno)));
    if (got == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
    if (text.size() > kLargestFile) throw InputError({path, 0}, "is larger than 8 MiB");
  }
}

Value read_toml(const std::string& path) {
  return parse_toml(read_text(path), path);
}

Value parse_toml(std::string_view text, const std::string& name) {
  if (text.size() > kLargestFile) throw InputError({name, 0}, "is larger than 8 MiB");
  check_encoding(text, name);
  if (const auto stumble = find_stumble(text, kMostKeyParts)) {
    throw InputError({{Place{name, stumble->line}, stumble->why}});
  }
  const toml::parse_result parsed = parse_or_refuse(text, name);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    const auto line = static_cast<int>(error.source().begin.line);
    throw InputError({{Place{name, line}, hint(text, line, error.description())}});
  }
  Converter converter(name);
  Value root = converter.convert(parsed.table(), 0);
  root.place = {name, 0};
  if (!converter.faults().empty()) throw InputError(converter.faults());
  return root;
}

}  // namespace millstudy::io
