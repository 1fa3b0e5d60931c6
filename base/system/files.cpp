#include "base/system/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/removal.hpp"
#include "base/system/sha256.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// The file that a write to `path` replaces. Throws Error(kOutput) for anything but a regular file: a rename would
/// replace a device by a file.
fs::path final_target(const fs::path& path, AtLink at_link) {
  std::error_code ignored;  // open() will say what is wrong with the path
  fs::path target = path;
  auto type = fs::symlink_status(path, ignored).type();
  if (type == fs::file_type::symlink) {
    if (at_link == AtLink::kReplace) return path;
    target = fs::weakly_canonical(path, ignored);
    if (target.empty()) cannot_write(path, ELOOP);
    type = fs::status(target, ignored).type();
  }
  if (type == fs::file_type::directory) cannot_write(path, EISDIR);
  if (type != fs::file_type::regular && fs::exists(fs::file_status(type)) &&
      type != fs::file_type::unknown)
    throw Error(ExitCode::kOutput, "{}: cannot write: not a regular file", path.string());
  return target;
}

/// Descriptors that finished files may hold until all are renamed.
std::size_t most_open_together() {
  constexpr rlim_t kFew = 16, kMany = 256;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return kFew;
  return std::clamp(limit.rlim_cur / 4, kFew, kMany);
}

thread_local int flushes_later = 0;  ///< FlushLater objects of the thread

void require_bound(const InputFile& file, std::uint64_t bytes, std::uint64_t max_bytes) {
  if (bytes > max_bytes)
    throw Error(ExitCode::kInput, "{}: {} bytes; at most {} are read", file.path().string(), bytes,
                max_bytes);
}

/// Whether the path still names the open file.
bool is_at(const fs::path& path, int fd) {
  struct stat there {
  }, open{};
  return ::lstat(path.c_str(), &there) == 0 && ::fstat(fd, &open) == 0 &&
         there.st_dev == open.st_dev && there.st_ino == open.st_ino;
}

}  // namespace

InputFile::InputFile(const fs::path& path)
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat status {};
  if (!file_ || ::fstat(file_.get(), &status) != 0)
    throw failure_of(path.string() + ": cannot read", errno, ExitCode::kInput);
  if (!S_ISREG(status.st_mode))
    throw Error(ExitCode::kInput, "{}: not a regular file", path.string());
  size_ = std::uint64_t(status.st_size);
}

fs::path InputFile::real_path() const {
  fs::path real = lobelia::real_path(path_, ExitCode::kInput);
  // The path may lead elsewhere by now, as may each folder in it: what counts is the kernel's word on the open file.
  std::error_code error;
  const fs::path open = fs::read_symlink(fmt::format("/proc/self/fd/{}", file_.get()), error);
  if (!error)
    real = open;
  else if (error != std::errc::no_such_file_or_directory)  // or else there is no /proc
    throw failure_of(path_.string() + ": cannot tell where it is", error.value(), ExitCode::kInput);
  if (!is_at(real, file_.get()))
    throw Error(ExitCode::kInput, "{}: it was replaced while it was opened", path_.string());
  return real;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

std::size_t read_in_pieces(int file, void* target, std::size_t size, std::size_t offset) {
  std::size_t done = 0;
  while (done < size) {
    if (done > 0) throw_if_interrupted();
    const std::size_t piece = std::min(kBytesBetweenLooks, size - done),
                      got = read_at(file, static_cast<char*>(target) + done, piece, offset + done);
    done += got;
    if (got < piece) break;
  }
  return done;
}

void read_pieces(const InputFile& file, std::uint64_t max_bytes,
                 const std::function<void(std::string_view)>& take) {
  constexpr std::size_t kPieceBytes = std::size_t{1} << 17;
  require_bound(file, file.size(), max_bytes);
  std::vector<char> piece(std::min(kPieceBytes, std::size_t(file.size()) + 1));
  std::uint64_t done = 0, next_look = kBytesBetweenLooks;
  while (true) {
    const ssize_t n = retried(
        [&] { return ::pread(file.descriptor(), piece.data(), piece.size(), off_t(done)); });
    if (n < 0) throw failure_of(file.path().string() + ": cannot read", errno, ExitCode::kInput);
    if (n == 0) return;
    done += std::uint64_t(n);
    require_bound(file, done, max_bytes);  // it may grow meanwhile
    take({piece.data(), std::size_t(n)});
    if (done < next_look) continue;
    throw_if_interrupted();
    next_look = done + kBytesBetweenLooks;
  }
}

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  return read_file(InputFile(path), max_bytes);
}

std::string read_file(const InputFile& file, std::uint64_t max_bytes) {
  require_bound(file, file.size(), max_bytes);
  std::string text(std::size_t(file.size()), '\0');
  const std::size_t size = read_in_pieces(file.descriptor(), text.data(), text.size());
  if (size < text.size() && errno != 0)
    throw failure_of(file.path().string() + ": cannot read", errno, ExitCode::kInput);
  text.resize(size);
  return text;
}

fs::file_type file_type_at(const fs::path& path, ExitCode otherwise) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  // A file that is missing is no fault. Of one that is too large for its size to be told, GCC's library says "unknown".
  if (error && type != fs::file_type::not_found)
    throw failure_of(path.string() + ": cannot read", error.value(), otherwise);
  return type;
}

fs::path real_path(const fs::path& path, ExitCode otherwise) {
  std::error_code error;
  fs::path real = fs::absolute(path, error);
  if (!error) real = fs::weakly_canonical(real, error);
  if (error)
    throw failure_of(path.string() + ": cannot tell where it is", error.value(), otherwise);
  return real;
}

std::vector<fs::path> regular_files_below(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(directory, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error))
    if (file_type_at(entry->path()) == fs::file_type::regular) files.push_back(entry->path());
  if (error)
    throw failure_of(directory.string() + ": cannot be listed", error.value(), ExitCode::kInput);
  return files;
}

PartFile::PartFile(const fs::path& path, AtLink at_link)
    : path_(path), target_(final_target(path, at_link)), part_([&] {
        constexpr int kMostTries = 5;
        for (int tries = 1;; ++tries) {
          const fs::path part = part_path(target_);
          file_ = Descriptor(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
          if (!file_) cannot_write(path, errno);
          ::flock(file_.get(), LOCK_EX);  // the lock tells others that it is not abandoned
          errno = ESTALE;
          if (is_at(part, file_.get())) return part;
          // Another machine, which does not know our process, removed it before it was locked; or we could not look.
          const int error = errno;
          file_.close();
          remove_part(part);
          if (tries == kMostTries) cannot_write(path, error);
        }
      }) {}

PartFile::~PartFile() {
  if (!file_) return;
  file_.close();
  remove_part(part_.path());
}

void PartFile::fail(int error) {
  file_.close();
  remove_part(part_.path());
  cannot_write(path_, error);
}

void PartFile::append(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kMostWaiting = 16384;
  if (waiting_.size() + bytes.size() > kMostWaiting) write_waiting();
  if (bytes.size() > kMostWaiting)
    write(size_, bytes);
  else
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  size_ += bytes.size();
}

void PartFile::append(std::string_view text) {
  append(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void PartFile::append_file(const fs::path& path) {
  read_pieces(InputFile(path), kMostHashedBytes, [this](std::string_view piece) { append(piece); });
}

void PartFile::write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  write_waiting();
  write(offset, bytes);
}

const fs::path& PartFile::part() {
  write_waiting();
  return part_.path();
}

void PartFile::write_waiting() {
  write(size_ - waiting_.size(), waiting_);
  waiting_.clear();
}

void PartFile::write(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = retried([&] {
      return ::pwrite(file_.get(), bytes.data() + done, bytes.size() - done, off_t(offset + done));
    });
    if (n < 0) fail(errno);
    done += std::size_t(n);
  }
}

void PartFile::flush() {
  if (!file_) return;
  write_waiting();
  // Without fsync a full disk may be noticed only after the rename.
  if (flushes_later == 0 && ::fsync(file_.get()) != 0 && errno != EINVAL) fail(errno);
}

void PartFile::close() {
  if (file_ && ::close(file_.release()) != 0) fail(errno);
}

void PartFile::finish() {
  if (FilesTogether* const together = FilesTogether::current_) {
    const std::lock_guard lock(together->mutex_);
    // They stay open until commit(): flushing several at once takes no longer than one, and their locks tell those who
    // cannot see this process that they are not abandoned.
    if (together->finished_.size() < most_open_together()) {
      write_waiting();
      ::sync_file_range(file_.get(), 0, 0, SYNC_FILE_RANGE_WRITE);  // begins to write it
    } else {
      flush();
      close();
    }
    waiting_.shrink_to_fit();  // there may be thousands
    together->finished_.push_back(std::move(*this));
    return;
  }
  flush();
  if (::rename(part_.path().c_str(), target_.c_str()) != 0) fail(errno);
  close();
}

FlushLater::FlushLater() { ++flushes_later; }

FlushLater::~FlushLater() { --flushes_later; }

FilesTogether* FilesTogether::current_ = nullptr;

FilesTogether::FilesTogether() { current_ = this; }

FilesTogether::~FilesTogether() {
  current_ = nullptr;
  for (const PartFile& file : finished_) remove_part(file.part_.path());
}

void FilesTogether::commit() {
  for (PartFile& file : finished_) file.flush();
  const EndDelay delay;
  throw_if_interrupted();
  for (PartFile& file : finished_) {
    if (::rename(file.part_.path().c_str(), file.target_.c_str()) != 0)
      cannot_write(file.path_, errno);
    file.close();
    file.part_.forget();
  }
  finished_.clear();
  interrupts_come_too_late();
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes, AtLink at_link) {
  PartFile file(path, at_link);
  file.append(bytes);
  file.finish();
}

void write_file(const fs::path& path, std::string_view text, AtLink at_link) {
  PartFile file(path, at_link);
  file.append(text);
  file.finish();
}

void require_writable(const fs::path& path) {
  if (path.filename().empty()) cannot_write(path, EISDIR);
  const fs::path target = final_target(path, AtLink::kFollow);
  remove_abandoned_parts(HeldDirectory(target.parent_path()), {target.filename().string()});
  const fs::path part = part_path(target);
  // A file without a name need not be removed. Where there is none, or the directory or the name is wrong, one with a
  // name is tried. (In a removed directory of tmpfs the first can be made and the second cannot.)
  const fs::path here = part.parent_path() / ".";
  struct stat status {};
  if (::stat(here.c_str(), &status) == 0 && status.st_nlink > 0 &&
      ::lstat(part.c_str(), &status) != 0 && errno == ENOENT &&
      Descriptor(::open(here.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666)))
    return;
  const EndDelay delay;
  const Descriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file) cannot_write(path, errno);
  remove_part(part);
}

void make_directories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  std::error_code ignored;
  if (!error && !fs::is_directory(path, ignored))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw Error(ExitCode::kOutput, "{}: cannot make the directory: {}", path.string(),
                error.message());
}

fs::path place_for_temporaries() {
  std::error_code error;
  fs::path place = fs::temp_directory_path(error);
  if (error)
    throw failure_of("$TMPDIR: no directory for temporary files", error.value(), ExitCode::kOutput);
  return place;
}

TemporaryDirectory::TemporaryDirectory() : TemporaryDirectory(place_for_temporaries()) {
  remove_abandoned_temporaries();
}

TemporaryDirectory::TemporaryDirectory(const fs::path& parent)
    : path_([&] {
        while (true) {
          std::string name = (parent / kTemporaryName).string() + "XXXXXX";
          if (::mkdtemp(name.data()) == nullptr) cannot_write(name, errno);
          lock_ = Descriptor(::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
          if (!lock_ && errno != ENOENT) {
            const int number = errno;
            remove_temporary(name);
            cannot_write(name, number);
          }
          if (lock_) ::flock(lock_.get(), LOCK_EX);
          if (lock_ && is_at(name, lock_.get())) return fs::path(name);
          // Before it was locked, another farm took it for one that a dead process left behind.
        }
      }) {}

TemporaryDirectory::~TemporaryDirectory() { remove_temporary(path()); }

void remove_abandoned_temporaries() {
  [[maybe_unused]] static const bool once = [] {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (!error) remove_dead_temporaries(parent);
    return true;
  }();
}

}  // namespace lobelia
