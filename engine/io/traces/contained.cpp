// SPDX-License-Identifier: MIT
#include "io/traces/contained.h"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <new>
#include <span>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "core/error.h"

namespace millstudy::io {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // they reserve terabytes of addresses
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

constexpr rlim_t kMostBytes = 6'000'000'000;  // more than twice kMostTraceValues
constexpr rlim_t kSecondsAtLeast = 3;         // of computing time, and one for every
constexpr std::size_t kBytesPerSecond = 5'000'000;

enum class Answer : std::uint8_t { kTrace = 1, kFaults = 2, kNoMemory = 3, kOther = 4 };

/// Both ends of a pipe; the system closes what is left when a process ends.
class End {
 public:
  explicit End(int file) : file_(file) {}
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  ~End() { ::close(file_); }

  bool write(const void* data, std::size_t size) const {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t done = ::write(file_, at, size);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      at += done;
      size -= static_cast<std::size_t>(done);
    }
    return true;
  }
  bool read(void* data, std::size_t size) const {
    char* at = static_cast<char*>(data);
    while (size > 0) {
      const ssize_t done = ::read(file_, at, size);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      at += done;
      size -= static_cast<std::size_t>(done);
    }
    return true;
  }

 private:
  int file_;
};

/// Writes values one after another; read back in the same order by Input.
class Output {
 public:
  explicit Output(const End& end) : end_(end) {}
  template <class T>
  void number(T value) {
    end_.write(&value, sizeof(value));
  }
  void text(const std::string& text) {
    number(std::uint64_t{text.size()});
    end_.write(text.data(), text.size());
  }
  void numbers(const std::vector<double>& values) {
    number(std::uint64_t{values.size()});
    end_.write(values.data(), values.size() * sizeof(double));
  }

 private:
  const End& end_;
};

/// What comes from a process that may have gone wrong: sizes are not trusted.
struct CutOff {};

class Input {
 public:
  explicit Input(const End& end) : end_(end) {}
  template <class T>
  T number() {
    T value{};
    if (!end_.read(&value, sizeof(value))) throw CutOff{};
    return value;
  }
  std::string text() {
    std::string text(bounded(1 << 20), '\0');
    if (!end_.read(text.data(), text.size())) throw CutOff{};
    return text;
  }
  std::vector<double> numbers() {
    std::vector<double> values(bounded(kMostTraceValues));
    if (!end_.read(values.data(), values.size() * sizeof(double))) throw CutOff{};
    return values;
  }
  std::size_t bounded(std::size_t most) {
    const auto size = number<std::uint64_t>();
    if (size > most) throw CutOff{};
    return size;
  }

 private:
  const End& end_;
};

void send(Output out, const TraceFile& file) {
  const identify::ChannelSet& set = file.channels;
  out.number(Answer::kTrace);
  out.text(file.format);
  out.number(std::uint64_t{set.channels.size()});
  for (const identify::Channel& channel : set.channels) {
    out.text(channel.name);
    out.text(channel.unit);
    out.numbers(channel.samples);
  }
  out.numbers(set.time);
  out.number(set.sampling_rate.value_or(0.0));
  out.number(set.start);
  out.number(std::uint64_t{set.remarks.size()});
  for (const std::string& remark : set.remarks) out.text(remark);
}

TraceFile receive_trace(Input& in) {
  TraceFile file;
  identify::ChannelSet& set = file.channels;
  file.format = in.text();
  set.channels.resize(in.bounded(1 << 20));
  for (identify::Channel& channel : set.channels) {
    channel.name = in.text();
    channel.unit = in.text();
    channel.samples = in.numbers();
  }
  set.time = in.numbers();
  const auto rate = in.number<double>();
  if (rate > 0.0) set.sampling_rate = rate;
  set.start = in.number<double>();
  set.remarks.resize(in.bounded(1 << 10));
  for (std::string& remark : set.remarks) remark = in.text();
  return file;
}

void send(Output out, const core::InputError& error) {
  out.number(Answer::kFaults);
  out.number(std::uint64_t{error.faults().size()});
  for (const core::Fault& fault : error.faults()) {
    out.text(fault.place.file);
    out.number(fault.place.line);
    out.text(fault.text);
  }
}

[[noreturn]] void receive_faults(Input& in) {
  std::vector<core::Fault> faults(in.bounded(1 << 10));
  for (core::Fault& fault : faults) {
    fault.place.file = in.text();
    fault.place.line = in.number<int>();
    fault.text = in.text();
  }
  throw core::InputError(std::move(faults));
}

void limit(int resource, rlim_t most) {
  rlimit now = {};
  if (getrlimit(resource, &now) != 0) return;
  now.rlim_cur = now.rlim_max == RLIM_INFINITY ? most : std::min(most, now.rlim_max);
  setrlimit(resource, &now);
}

/// The process that reads. It ends without what a program does at its end: files that its parent
/// has open are not its own.
[[noreturn]] void work(const Source& source, const std::function<TraceFile()>& read,
                       const End& end) {
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGXCPU}) {
    signal(number, SIG_DFL);
  }
  signal(SIGPIPE, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kSecondsAtLeast + source.bytes.size() / kBytesPerSecond);
  if (!kSanitized) limit(RLIMIT_AS, kMostBytes + source.bytes.size());
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);  // the last words of a library that fails
  try {
    send(Output(end), read());
  } catch (const core::InputError& error) {
    send(Output(end), error);
  } catch (const std::bad_alloc&) {
    Output(end).number(Answer::kNoMemory);
  } catch (const std::exception& error) {
    Output(end).number(Answer::kOther);
    Output(end).text(error.what());
  }
  _exit(0);
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

TraceFile receive(const Source& source, const End& end) {
  Input in(end);
  const core::Place place{source.path, 0};
  switch (in.number<Answer>()) {
    case Answer::kTrace:
      return receive_trace(in);
    case Answer::kFaults:
      receive_faults(in);
    case Answer::kNoMemory:
      throw core::InputError(place, "needs too much memory, or is damaged");
    case Answer::kOther:
      throw core::InputError(place, "cannot be read: " + in.text());
  }
  throw CutOff{};
}

}  // namespace

TraceFile read_contained(const Source& source, const std::function<TraceFile()>& read) {
  int ends[2] = {};
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  }
  const End reading(ends[0]);
  pid_t process = -1;
  {
    const End writing(ends[1]);
    process = fork();
    if (process == 0) {
      ::close(ends[0]);  // or it waits for itself when nobody else reads any more
      work(source, read, writing);
    }
  }
  if (process < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot start a process");
  }
  try {
    TraceFile file = receive(source, reading);
    wait_for(process);
    return file;
  } catch (const CutOff&) {
    kill(process, SIGKILL);  // it may still be writing
    const int status = wait_for(process);
    const bool too_long = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
    throw core::InputError({source.path, 0}, too_long
                                                 ? "takes too long to read: it is damaged"
                                                 : "is damaged: the library that reads it failed");
  } catch (...) {
    kill(process, SIGKILL);
    wait_for(process);
    throw;
  }
}

}  // namespace millstudy::io
