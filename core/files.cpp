#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <random>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kTemporaryName[] = "lobelia-temporary-";

/// Closes on every way out; close() errors are looked at where they matter.
struct FileDescriptor {
  int fd = -1;
  ~FileDescriptor() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void output_error(const fs::path& path, int error) {
  throw Error(ExitCode::kOutput,
              fmt::format("{}: cannot write: {}", path.string(), std::strerror(error)));
}

bool names_directory(const fs::path& path) {
  std::error_code ignored;  // open() will say what is wrong with the path
  return fs::is_directory(path, ignored);
}

/// Where a write to `path` ends up: the file behind a symbolic link is replaced, not the link.
/// Throws Error(kOutput) for what is there and is not a regular file: a rename would replace a
/// device by a file.
fs::path final_target(const fs::path& path) {
  std::error_code ignored;
  fs::path target = path;
  if (fs::is_symlink(path, ignored)) {
    target = fs::weakly_canonical(path, ignored);
    if (target.empty()) output_error(path, ELOOP);
  }
  if (names_directory(target)) output_error(path, EISDIR);
  const auto type = fs::status(target, ignored).type();
  if (type != fs::file_type::regular && fs::exists(fs::file_status(type)) &&
      type != fs::file_type::unknown)
    throw Error(ExitCode::kOutput,
                fmt::format("{}: cannot write: not a regular file", path.string()));
  return target;
}

/// By chance besides the process's number, which another machine or container may have too.
fs::path temporary_name(const fs::path& path) {
  static thread_local std::random_device device;
  return path.parent_path() /
         fmt::format(".{}.{}-{}.part", path.filename().string(), ::getpid(), device());
}

}  // namespace

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  const FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (file.fd < 0 || ::fstat(file.fd, &status) != 0)
    throw Error(ExitCode::kInput,
                fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  if (!S_ISREG(status.st_mode))
    throw Error(ExitCode::kInput, fmt::format("{}: not a regular file", path.string()));
  if (std::uint64_t(status.st_size) > max_bytes)
    throw Error(ExitCode::kInput, fmt::format("{}: {} bytes; at most {} are read", path.string(),
                                              std::uint64_t(status.st_size), max_bytes));
  std::string text(std::size_t(status.st_size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::read(file.fd, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error(ExitCode::kInput,
                  fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
    if (n == 0) break;
    done += std::size_t(n);
  }
  text.resize(done);
  return text;
}

PartFile::PartFile(const fs::path& path)
    : path_(path), target_(final_target(path)), part_([&] {
        const fs::path part = temporary_name(target_);
        fd_ = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd_ < 0) output_error(path, errno);
        return part;
      }) {
  ::flock(fd_, LOCK_EX);  // by which others see that it is not abandoned
}

PartFile::~PartFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(part_.path().c_str());
}

void PartFile::fail(int error) {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  ::unlink(part_.path().c_str());
  output_error(path_, error);
}

void PartFile::append(std::span<const std::uint8_t> bytes) {
  write_at(size_, bytes);
  size_ += bytes.size();
}

void PartFile::write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::pwrite(fd_, bytes.data() + done, bytes.size() - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    done += std::size_t(n);
  }
}

void PartFile::finish() {
  // Without it a full disk may be noticed only after the rename.
  if (::fsync(fd_) != 0 && errno != EINVAL) fail(errno);
  const int closed = ::close(std::exchange(fd_, -1));
  if (closed != 0) fail(errno);
  if (FilesTogether::add(*this)) return;
  if (::rename(part_.path().c_str(), target_.c_str()) != 0) fail(errno);
}

struct FilesTogether::State {
  struct Waiting {
    fs::path path, target;
    TemporaryPath part;
  };
  std::mutex mutex;
  std::vector<Waiting> files;
};

FilesTogether* FilesTogether::current_ = nullptr;

FilesTogether::FilesTogether() : state_(std::make_unique<State>()) { current_ = this; }

FilesTogether::~FilesTogether() {
  current_ = nullptr;
  for (const auto& file : state_->files) ::unlink(file.part.path().c_str());
}

bool FilesTogether::add(PartFile& file) {
  if (!current_) return false;
  const std::lock_guard lock(current_->state_->mutex);
  current_->state_->files.push_back({file.path_, file.target_, std::move(file.part_)});
  return true;
}

void FilesTogether::commit() {
  const EndDelay delay;
  throw_if_interrupted();
  for (State::Waiting& file : state_->files) {
    if (::rename(file.part.path().c_str(), file.target.c_str()) != 0)
      output_error(file.path, errno);
    file.part.forget();
  }
  state_->files.clear();
  interrupts_come_too_late();
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  PartFile file(path);
  file.append(bytes);
  file.finish();
}

void write_file(const fs::path& path, std::string_view text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void require_writable(const fs::path& path) {
  if (path.filename().empty()) output_error(path, EISDIR);
  const fs::path part = temporary_name(final_target(path));
  const EndDelay delay;
  const FileDescriptor file{::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
  if (file.fd < 0) output_error(path, errno);
  ::unlink(part.c_str());
}

void make_directories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !names_directory(path)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw Error(ExitCode::kOutput,
                fmt::format("{}: cannot make the directory: {}", path.string(), error.message()));
}

TemporaryDirectory::TemporaryDirectory() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error)
    throw Error(ExitCode::kOutput,
                fmt::format("$TMPDIR: no directory for temporary files: {}", error.message()));
  path_.emplace([&] {
    std::string name = (parent / kTemporaryName).string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) output_error(name, errno);
    return fs::path(name);
  });
  alive_ = ::open(path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (alive_ >= 0) ::flock(alive_, LOCK_EX);
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path(), ignored);
  if (alive_ >= 0) ::close(alive_);
}

void remove_abandoned_temporaries() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(error), error)) {
    if (!entry.path().filename().native().starts_with(kTemporaryName)) continue;
    const FileDescriptor directory{
        ::open(entry.path().c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)};
    struct stat status {};
    // One that is empty may have been made just now, and be locked next.
    if (directory.fd < 0 || ::fstat(directory.fd, &status) != 0 || status.st_uid != ::geteuid() ||
        ::flock(directory.fd, LOCK_EX | LOCK_NB) != 0 || fs::is_empty(entry.path(), error) || error)
      continue;
    fs::remove_all(entry.path(), error);
  }
}

void remove_abandoned_files(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(".part")) continue;
    // ".NAME.PID-N.part"
    const auto dash = name.rfind('-'), dot = name.rfind('.', dash);
    long long pid = 0;
    if (dash == name.npos || dot == name.npos || dot > dash ||
        !parse_integer(name.substr(dot + 1, dash - dot - 1), pid) || pid <= 0)
      continue;
    if (::kill(pid_t(pid), 0) == 0 || errno != ESRCH) continue;
    // There is no such process here; on another machine there may be.
    const FileDescriptor file{::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (file.fd < 0 || ::flock(file.fd, LOCK_EX | LOCK_NB) != 0) continue;
    fs::remove(entry.path(), error);
  }
}

}  // namespace lobelia
