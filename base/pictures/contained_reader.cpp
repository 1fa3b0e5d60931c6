#include "base/pictures/contained_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "base/pictures/image_io_module.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_message.hpp"
#include "base/pictures/reading_limits.hpp"
#include "base/system/descriptor.hpp"
#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/scratch_memory.hpp"
#include "base/system/spawn.hpp"
#include "base/system/threads.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

std::atomic<bool> g_on_one_thread{false}, g_any_format{false};

constexpr char kStopped[] = "the decoder stopped in the middle";
constexpr int kNotLoaded = 127;        // exit code of the dynamic linker
constexpr int kPollMilliseconds = 50;  // between looks for Ctrl-C

[[noreturn]] void system_failure(const char* what, int error) {
  throw failure_of(fmt::format("{}: {}", kReaderFile, what), error, ExitCode::kInput);
}

/// Waits until there is something to read or the other side is gone. Throws Error(kInterrupted).
void wait_for_input(int descriptor) {
  for (;;) {
    throw_if_interrupted();
    pollfd wait{descriptor, POLLIN, 0};
    const int ready = ::poll(&wait, 1, kPollMilliseconds);
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR) system_failure("poll", errno);
  }
}

/// Returns how many bytes came before the other side closed the pipe.
std::size_t read_from_pipe(int pipe, void* target, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    wait_for_input(pipe);
    const ssize_t n = ::read(pipe, static_cast<char*>(target) + done, size - done);
    if (n == 0) break;
    if (n > 0) done += std::size_t(n);
    if (n < 0 && errno != EINTR && errno != EAGAIN) system_failure("read", errno);
  }
  return done;
}

/// The part of our environment that the reader gets: the paths of libraries and the options of sanitizers.
std::vector<std::string> reader_environment() {
  std::vector<std::string> result;
  for (const char* name :
       {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS"})
    if (const char* value = std::getenv(name)) result.push_back(fmt::format("{}={}", name, value));
  return result;
}

/// The outcome of one request.
struct Outcome {
  Picture picture;
  std::vector<std::string> names;
  std::string problem;       ///< empty if there is none
  bool is_complete = false;  ///< the problem is a complete message, with the file's name
};

/// A running lobelia_picture_reader.
class Reader {
 public:
  Reader() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
      system_failure("socketpair", errno);
    socket_ = Descriptor(ends[0]);
    const Descriptor theirs(ends[1]);
    const Descriptor null(::open("/dev/null", O_WRONLY | O_CLOEXEC));
    if (null.get() < 0) system_failure("/dev/null", errno);
    // In a process group of its own, because we answer Ctrl-C. It ends when the socket is closed.
    pid_ = spawn({.arguments = {companion_file(kReaderFile).string()},
                  .environment = reader_environment(),
                  .working_directory = {},
                  .input = theirs.get(),
                  .output = null.get()})
               .pid;
  }
  ~Reader() { end(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// False if the reader is gone.
  bool send(const std::string& request, int file, int pipe) const {
    iovec part{const_cast<char*>(request.data()), request.size()};
    const std::array<int, kRequestDescriptors> descriptors{file, pipe};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)] = {};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptors);
    std::memcpy(CMSG_DATA(header), descriptors.data(), sizeof descriptors);
    return ::sendmsg(socket_.get(), &message, MSG_NOSIGNAL) == ssize_t(request.size());
  }

  /// Ends the reader. Returns its status, as of wait(2): of one that has ended by itself its own, also if it is not gone
  /// yet.
  int end() {
    if (!has_ended_) {
      ::kill(-pid_, SIGKILL);
      retried([&] { return ::waitpid(pid_, &status_, 0); });
    }
    has_ended_ = true;
    return status_;
  }

  /// False if the reader is gone.
  bool receive(ReaderVerdict& verdict) const {
    return retried([&] {
             wait_for_input(socket_.get());
             return ::recv(socket_.get(), &verdict, sizeof verdict, 0);
           }) == sizeof verdict;
  }

 private:
  Descriptor socket_;
  pid_t pid_ = 0;
  bool has_ended_ = false;
  int status_ = 0;
};

/// Idle readers. One that was interrupted or is gone is not given back.
class Pool {
 public:
  std::unique_ptr<Reader> take() {
    std::unique_lock lock(mutex_);
    if (idle_.empty()) {
      lock.unlock();
      return std::make_unique<Reader>();
    }
    auto reader = std::move(idle_.back());
    idle_.pop_back();
    return reader;
  }
  void give_back(std::unique_ptr<Reader> reader) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(reader));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Reader>> idle_;
};

/// A length and as many bytes, at most `most`; nothing if there are not as many.
std::optional<std::string> receive_text(int pipe, std::uint64_t most) {
  std::uint64_t size = 0;
  if (read_from_pipe(pipe, &size, sizeof size) != sizeof size || size > most) return std::nullopt;
  std::string bytes(size, '\0');
  if (read_from_pipe(pipe, bytes.data(), size) != size) return std::nullopt;
  return bytes;
}

/// Fills in a picture's values. Returns false, with the reason in `outcome`, if they do not all come.
bool receive_values(int pipe, std::span<std::byte> values, Outcome& outcome) {
  constexpr std::size_t kPart = std::size_t{4} << 20;
  while (!values.empty()) {
    std::uint64_t size = 0;
    if (read_from_pipe(pipe, &size, sizeof size) != sizeof size) break;
    if (size == kNoMoreValues) {
      auto refusal = receive_text(pipe, kMaxRequestBytes);
      if (!refusal) break;
      outcome.is_complete = true;
      outcome.problem = std::move(*refusal);
      return false;
    }
    if (size == 0 || size > values.size()) break;
    for (std::uint64_t done = 0; done < size;) {
      const std::size_t part = std::min<std::size_t>(kPart, size - done);
      if (read_from_pipe(pipe, values.data() + done, part) != part) {
        outcome.problem = kStopped;
        return false;
      }
      looked_at(part);
      done += part;
    }
    values = values.subspan(size);
  }
  if (!values.empty()) outcome.problem = kStopped;
  return values.empty();
}

/// Reads the answer. Trusts nothing in it before it is checked.
Outcome receive_answer(int pipe) {
  Outcome outcome;
  const std::optional<std::string> bytes = receive_text(pipe, kMaxAnswerBytes);
  if (!bytes) {
    outcome.problem = "the decoder gave no answer";
    return outcome;
  }
  try {
    ReadingAnswer answer = unpack_answer(*bytes);
    outcome.names = std::move(answer.names);
    outcome.is_complete = answer.kind == ReadingAnswer::Kind::kRefusal;
    outcome.problem = std::move(answer.refusal);
    if (answer.kind != ReadingAnswer::Kind::kPicture) return outcome;
    const PixelWindow& data = answer.source.data;
    outcome.picture.image = Image(int(answer.width), int(answer.height));
    if (answer.has_overscan) outcome.picture.overscan = Image(data.width, data.height);
    outcome.picture.source = std::move(answer.source);
  } catch (const std::runtime_error& error) {
    outcome.problem = fmt::format("the decoder's answer is damaged: {}", error.what());
    return outcome;
  }
  for (Image* image : {&outcome.picture.image, &outcome.picture.overscan})
    if (!receive_values(pipe, std::as_writable_bytes(image->values()), outcome)) break;
  return outcome;
}

/// `status` is the reader's, as of wait(2).
[[noreturn]] void throw_failed_twice(const fs::path& picture, int status) {
  const std::string program = companion_file(kReaderFile).string();
  const bool exited = WIFEXITED(status);
  const int code = exited ? WEXITSTATUS(status) : WTERMSIG(status);
  if (exited && code == int(ExitCode::kInput))
    throw Error(ExitCode::kInput, "{}: a library that it needs is missing or cannot be read",
                program);
  throw Error(exited && code == int(ExitCode::kInternal) ? ExitCode::kInternal : ExitCode::kInput,
              fmt::format("{}: failed twice to read {} ({} {})", program, picture.string(),
                          exited ? "exit code" : "signal", code));
}

[[noreturn]] void throw_not_loaded() {
  throw Error(ExitCode::kNoResources,
              "{}: OpenImageIO could not be loaded within {} s. Perhaps the system "
              "gives no more threads (ulimit -u, cgroup pids.max)",
              kReaderFile, kSecondsToLoad);
}

/// Empty if the decoder ended normally.
std::string decoder_problem(const ReaderVerdict& verdict) {
  if (verdict.too_long) return "the decoder did not end; it was stopped";
  if (WIFSIGNALED(verdict.status) && WTERMSIG(verdict.status) == SIGXCPU)
    return "decoding takes longer than a file of this size justifies";
  if (WIFSIGNALED(verdict.status))
    return fmt::format("the decoder crashed (signal {})", WTERMSIG(verdict.status));
  if (WEXITSTATUS(verdict.status) != 0)
    return fmt::format("the decoder failed (exit code {})", WEXITSTATUS(verdict.status));
  return "";
}

enum class Asked : std::uint8_t { kPicture, kStoredPicture, kNames };

Outcome ask(const PictureFile& file, const std::string& layer, Asked asked,
            const PictureLimit& limit) {
  static Pool pool;
  // Once is enough: another picture would wait as long.
  static std::atomic<bool> not_loaded{false};
  if (not_loaded) throw_not_loaded();
  throw_if_interrupted();
  const fs::path& path = file.path();
  ReadingRequest request{.names_only = asked == Asked::kNames,
                         .on_one_thread = g_on_one_thread || usual_threads() == 1,
                         .as_stored = asked == Asked::kStoredPicture,
                         .format = {},
                         .path = path.string(),
                         .layer = layer,
                         .limit = limit};
  Descriptor copy;
  if (g_any_format)
    copy = file.copy_in_memory(kMaxAnyFormatBytes);
  else
    request.format = file.known_format();
  const std::string message = pack(request);
  if (message.size() > kMaxRequestBytes)
    throw Error(ExitCode::kInput, "{}: no layer '{}'", path.string(), printable(layer));

  const int shown = g_any_format ? copy.get() : file.descriptor();
  for (int attempt = 0;; ++attempt) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) system_failure("pipe", errno);
    Descriptor answer(ends[0]);
    Descriptor theirs(ends[1]);
    ::fcntl(theirs.get(), F_SETPIPE_SZ, 1 << 20);  // faster, but not necessary
    auto reader = pool.take();
    const bool sent = reader->send(message, shown, theirs.get());
    theirs.close();
    ReaderVerdict verdict;
    if (sent) {
      Outcome outcome = receive_answer(answer.get());
      answer.close();  // a decoder that has more to say ends
      if (reader->receive(verdict)) {
        pool.give_back(std::move(reader));
        const std::string why = decoder_problem(verdict);
        if (why.empty() && outcome.problem.empty()) return outcome;
        if (why.empty() && outcome.is_complete)
          throw Error(ExitCode::kInput, printable(outcome.problem, kMaxRequestBytes));
        unreadable_picture(path, why.empty() ? outcome.problem : why);
      }
    }
    // It lives if it could not be reached, and would wait for ever.
    const int status = reader->end();
    if (WIFEXITED(status) && WEXITSTATUS(status) == int(ExitCode::kNoResources))
      throw Error(ExitCode::kNoResources,
                  "{}: not enough memory or processes (ulimit -v, -d or -u, cgroup "
                  "memory.max or pids.max)",
                  kReaderFile);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotLoaded)
      throw Error(ExitCode::kNoResources,
                  "{}: cannot be loaded: a library is missing, or there is not enough "
                  "memory (ulimit -v or -d) or too many files are open (ulimit -n)",
                  kReaderFile);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
      not_loaded = true;
      throw_not_loaded();
    }
    // A picture cannot end the reader itself, so it was killed, or the system failed it. A second try gets a new one.
    if (attempt == 1) throw_failed_twice(path, status);
  }
}

}  // namespace

Picture read_picture(const fs::path& path, const std::string& layer, const PictureLimit& limit) {
  return read_picture(PictureFile(path), layer, limit);
}

Picture read_picture(const PictureFile& file, const std::string& layer, const PictureLimit& limit) {
  return ask(file, layer, Asked::kPicture, limit).picture;
}

Picture read_stored_picture(const fs::path& path, const std::string& layer) {
  return ask(PictureFile(path), layer, Asked::kStoredPicture, {}).picture;
}

std::vector<std::string> layer_names(const fs::path& path) {
  return ask(PictureFile(path), "", Asked::kNames, {}).names;
}

void decode_contained_on_one_thread() { g_on_one_thread = true; }

void read_any_picture_format(bool any) { g_any_format = any; }

}  // namespace lobelia
