// lobelia_picture_reader: decodes pictures for the program, each in a process of its own
// (base/pictures/contained_reader.hpp).
//
// It stays single-threaded, so that a fork is complete, and looks at no picture itself. What is plain
// (base/pictures/plain_picture.hpp) needs no OpenImageIO.
#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <new>
#include <thread>

#include "base/pictures/image_io_module.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_message.hpp"
#include "base/pictures/plain_picture.hpp"
#include "base/pictures/png_module.hpp"
#include "base/pictures/reading_limits.hpp"
#include "base/system/descriptor.hpp"
#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/threads.hpp"

namespace lobelia {
namespace {

constexpr int kProgram = 0;  // the socket to the program

/// A child's exit code, of which nothing was answered: the picture is not plain, and OpenImageIO is not loaded.
constexpr int kNotPlain = 42;

/// Smaller EXRs are decoded on one thread: starting more takes longer.
constexpr std::size_t kManyThreadsBytes = std::size_t{1} << 20;

std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

/// Whether there may be a thread for each processor: oneTBB gives up where one cannot be started.
bool can_start_threads() {
  const int more = int(std::thread::hardware_concurrency()) - 1;
  return startable_threads(more) >= more;
}

struct Job {
  ReadingRequest request;
  int file = -1, answer = -1;
};

/// False when no more jobs come.
bool receive(Job& job) {
  std::string bytes(kMaxRequestBytes, '\0');
  std::array<int, kRequestDescriptors> descriptors{};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)] = {};
  iovec part{bytes.data(), bytes.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t n = retried([&] { return ::recvmsg(kProgram, &message, MSG_CMSG_CLOEXEC); });
  const cmsghdr* header = n > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
  if (!header || header->cmsg_len != CMSG_LEN(sizeof descriptors)) return false;
  std::memcpy(descriptors.data(), CMSG_DATA(header), sizeof descriptors);
  job = {unpack_request({bytes.data(), std::size_t(n)}), descriptors[0], descriptors[1]};
  return true;
}

void write_all(int descriptor, const void* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = retried(
        [&] { return ::write(descriptor, static_cast<const char*>(bytes) + done, size - done); });
    if (n <= 0) ::_exit(1);
    done += std::size_t(n);
  }
}

/// OpenImageIO's decoder of TGA leaves the missing pixels of a damaged file uninitialised, and those of --any-format may
/// do so too. Other libraries refuse or fill such a file. They are not checked, because it is slow: OpenImageIO allocates
/// 64 MB at once, and a fill touches all of them.
bool may_leave_memory_uninitialised(std::string_view format) {
  return format == "targa" || format.empty();
}

bool are_same(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  return a.pixel_count() == 0 ||
         std::memcmp(a.values().data(), b.values().data(), a.values().size_bytes()) == 0;
}

/// Reads it by OpenImageIO, twice for some formats, into memory with different fills: pixels that differ are not in the
/// file.
Picture read_checked(const ImageIoTable& table, const PictureBytes& file,
                     const std::string& layer) {
  Picture picture = table.read_picture(file, layer);
  if (!may_leave_memory_uninitialised(file.format)) return picture;
  ::mallopt(M_PERTURB, 0x5a);
  const Picture again = table.read_picture(file, layer);
  if (!are_same(picture.image, again.image) || !are_same(picture.overscan, again.overscan))
    unreadable_picture(file.path, "some of its pixels are not in the file");
  return picture;
}

/// Sends the answer to the program: what the picture is, and then its values in pieces (base/pictures/picture_message.hpp).
class Sender {
 public:
  explicit Sender(int pipe) : pipe_(pipe) {}

  bool has_begun() const { return has_begun_; }
  void begin(const ReadingAnswer& answer) {
    has_begun_ = true;
    send(pack(answer));
  }
  void send_values(const Image& image) {
    const auto bytes = std::as_bytes(image.values());
    send({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  /// Instead of the values that are left.
  void send_refusal(const std::string& refusal) {
    write_all(pipe_, &kNoMoreValues, sizeof kNoMoreValues);
    send(refusal);
  }

 private:
  void send(std::string_view bytes) {
    const std::uint64_t length = bytes.size();
    write_all(pipe_, &length, sizeof length);
    write_all(pipe_, bytes.data(), bytes.size());
  }
  int pipe_;
  bool has_begun_ = false;
};

ReadingAnswer answer_of(const PictureSource& source, int width, int height, bool has_overscan) {
  ReadingAnswer answer;
  answer.kind = ReadingAnswer::Kind::kPicture;
  answer.source = source;
  answer.width = std::uint64_t(width);
  answer.height = std::uint64_t(height);
  answer.has_overscan = has_overscan;
  return answer;
}

ReadingAnswer decode(const ImageIoTable* table, const Job& job, std::string_view bytes,
                     std::uint64_t began_with, Picture& picture, Sender& sender) {
  const ReadingRequest& request = job.request;
  PictureBytes file{.path = request.path,
                    .bytes = bytes,
                    .format = request.format,
                    .on_one_thread = request.on_one_thread || bytes.size() < kManyThreadsBytes ||
                                     !can_start_threads(),
                    .as_stored = request.as_stored};
  if (request.format.empty()) file.reopen = fmt::format("/proc/self/fd/{}", job.file);
  if (!may_leave_memory_uninitialised(request.format))
    file.on_rows = [&](const Picture& band, int) {
      const PixelWindow& all = band.source.display;
      if (!sender.has_begun()) sender.begin(answer_of(band.source, all.width, all.height, false));
      sender.send_values(band.image);
      // The part of the file that was read need not stay in memory.
      ::madvise(const_cast<char*>(bytes.data()), bytes.size(), MADV_DONTNEED);
    };
  std::uint64_t allowance = kMemoryToOpen;
  file.on_header = [&](const PictureClaim& claim) {
    if (const std::string problem = claim_problem(claim, bytes.size(), request.limit);
        !problem.empty())
      unreadable_picture(file.path, problem);
    allowance = memory_to_read(claim, bytes.size());
    limit_memory(began_with + allowance);
    limit_processor_time(seconds_to_read(claim, bytes.size()));
  };
  ReadingAnswer answer;
  const auto needs_table = [&] {
    if (!table) ::_exit(kNotPlain);
    if (file.on_one_thread) table->decode_on_calling_threads();
  };
  try {
    if (request.names_only) {
      auto names = plain_layer_names(file);
      if (!names) needs_table();
      answer.names = names ? std::move(*names) : table->layer_names(file);
      answer.kind = ReadingAnswer::Kind::kNames;
      return answer;
    }
    auto plain = read_plain_picture(file, request.layer);
    if (!plain) needs_table();
    picture = plain ? std::move(*plain) : read_checked(*table, file, request.layer);
    answer = answer_of(picture.source, picture.image.width(), picture.image.height(),
                       picture.overscan.pixel_count() > 0);
  } catch (const std::bad_alloc&) {
    limit_memory(began_with + 2 * allowance);  // for the message
    answer.refusal = fmt::format("{}: not a readable picture: it needs more than {} MB of memory",
                                 request.path, allowance / 1'000'000);
  } catch (const std::exception& error) {
    answer.refusal = error.what();
  }
  return answer;
}

/// Runs in the child.
[[noreturn]] void serve(const ImageIoTable* table, const Job& job, std::uint64_t began_with) {
  ::close(kProgram);
  struct stat status {};
  ::fstat(job.file, &status);
  const auto size = std::size_t(status.st_size);
  ::mallopt(M_ARENA_MAX, 1);  // an arena for each thread would take address space
  if (may_leave_memory_uninitialised(job.request.format)) ::mallopt(M_PERTURB, 0xa5);
  limit_memory(began_with + kMemoryToOpen + size);
  limit_processor_time(seconds_to_read({}, size));
  lock_down(job.request.format.empty());
  // If the file becomes shorter meanwhile, only this process crashes.
  const void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, job.file, 0);
  if (bytes == MAP_FAILED) ::_exit(1);
  Picture picture;
  Sender sender(job.answer);
  const ReadingAnswer answer = decode(table, job, {static_cast<const char*>(bytes), size},
                                      began_with + size, picture, sender);
  if (sender.has_begun()) {
    if (answer.kind == ReadingAnswer::Kind::kRefusal) sender.send_refusal(answer.refusal);
    ::_exit(0);
  }
  sender.begin(answer);
  for (const Image* image : {&picture.image, &picture.overscan})
    if (image->pixel_count() > 0) sender.send_values(*image);
  ::_exit(0);
}

/// Waits for the end of the child, and kills it after `seconds`. If the program is gone, this process ends too.
ReaderVerdict wait_for_child(pid_t child, int alive, std::uint64_t seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  ReaderVerdict verdict;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd waits[] = {{alive, POLLIN, 0}, {kProgram, POLLRDHUP, 0}};
    const int ready = ::poll(waits, 2, int(std::clamp<std::int64_t>(left.count(), 0, 1 << 30)));
    if (ready < 0 && errno == EINTR) continue;
    if (waits[0].revents != 0) break;
    ::kill(child, SIGKILL);
    if (waits[1].revents != 0) ::_exit(0);
    verdict.too_long = true;
    break;
  }
  retried([&] { return ::waitpid(child, &verdict.status, 0); });
  return verdict;
}

/// OpenImageIO is loaded for the first picture that needs it, because a fork with its libraries takes longer too.
class Server {
 public:
  /// Answers a job. False if the program is gone.
  bool answer(const Job& job) {
    struct stat status {};
    ::fstat(job.file, &status);
    const std::uint64_t most = seconds_to_wait(std::uint64_t(status.st_size), job.request.limit);
    if (job.request.format == "png") png_table();
    if (!may_be_plain(job.request.format)) load();
    const bool was_loaded = table_ != nullptr;
    ReaderVerdict verdict = decode_in_child(job, most);
    if (!was_loaded && WIFEXITED(verdict.status) && WEXITSTATUS(verdict.status) == kNotPlain) {
      load();
      verdict = decode_in_child(job, most);
    }
    for (const int mine : {job.file, job.answer}) ::close(mine);
    return ::send(kProgram, &verdict, sizeof verdict, MSG_NOSIGNAL) >= 0;
  }

 private:
  /// Ends the process if that takes too long: a library that starts threads while it is loaded, as log4cplus does, may wait
  /// for ever where the system refuses one.
  void load() {
    if (table_) return;
    ::alarm(kSecondsToLoad);
    table_ = &image_io_table();
    table_->load_formats();
    ::alarm(0);
  }
  ReaderVerdict decode_in_child(const Job& job, std::uint64_t most_seconds) const {
    const std::uint64_t began_with = address_space();
    int alive[2];
    const auto fails = [](bool has) {
      if (has) throw Error(ExitCode::kNoResources, "no more processes or files");
    };
    fails(::pipe2(alive, O_CLOEXEC) != 0);
    const pid_t child = ::fork();
    if (child == 0) serve(table_, job, began_with);
    ::close(alive[1]);
    fails(child < 0);
    const ReaderVerdict verdict = wait_for_child(child, alive[0], most_seconds);
    ::close(alive[0]);
    return verdict;
  }

  const ImageIoTable* table_ = nullptr;
};

int run() {
  ::close_range(3, ~0u, 0);  // whatever the program left open
  ::signal(SIGCHLD, SIG_DFL);
  ::signal(SIGXCPU, SIG_DFL);
  ::signal(SIGALRM, SIG_DFL);
  Server server;
  for (Job job; receive(job);)
    if (!server.answer(job)) break;
  return 0;
}

}  // namespace
}  // namespace lobelia

int main() {
  try {
    return lobelia::run();
  } catch (const lobelia::Error& error) {
    return int(error.code());
  } catch (const std::exception& error) {
    return int(lobelia::as_error(error).code());
  }
}
