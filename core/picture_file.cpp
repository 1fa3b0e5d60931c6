#include "core/picture_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/no_resources.hpp"
#include "core/picture_bytes.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

[[noreturn]] void cannot_open(const std::filesystem::path& path, int error) {
  if (!lacking(error).empty()) throw failure_of(path.string(), error, ExitCode::kInput);
  unreadable_picture(path, error == ENOENT ? "no such file" : std::strerror(error));
}

}  // namespace

void unreadable_picture(const std::filesystem::path& path, std::string_view why) {
  throw Error(ExitCode::kInput,
              fmt::format("{}: not a readable picture: {}", path.string(), printable(why, 300)));
}

PictureFile::PictureFile(const std::filesystem::path& path) : path_(path) {
  // Opening a pipe would wait for whoever writes to it.
  file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (descriptor() < 0) cannot_open(path, errno);
  struct stat status {};
  std::string problem;
  if (::fstat(descriptor(), &status) != 0)
    problem = std::strerror(errno);
  else if (!S_ISREG(status.st_mode))
    problem = "not a regular file";
  else if (status.st_size == 0)
    problem = "the file is empty";
  else if (std::uint64_t(status.st_size) > kMaxPictureBytes)
    problem =
        fmt::format("the file has {} bytes; at most {} are read", status.st_size, kMaxPictureBytes);
  size_ = std::uint64_t(status.st_size);
  if (!problem.empty()) unreadable_picture(path, problem);
}

std::string PictureFile::read(std::uint64_t offset, std::size_t size) const {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::pread(descriptor(), bytes.data() + done, size - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) unreadable_picture(path_, std::strerror(errno));
    if (n == 0) unreadable_picture(path_, "it became shorter while it was read");
    done += std::size_t(n);
  }
  return bytes;
}

std::string PictureFile::read_all() const { return read(0, size_); }

std::string_view PictureFile::known_format() const {
  constexpr std::uint64_t kHeadBytes = 64;
  const std::uint64_t footer = std::min<std::uint64_t>(size_, kFooterBytes);
  const std::string_view format =
      picture_format(read(0, std::min(size_, kHeadBytes)), read(size_ - footer, footer),
                     path_.extension().string());
  if (format.empty())
    unreadable_picture(path_,
                       fmt::format("its first bytes are not those of {} (compare and profile open "
                                   "other formats with --any-format)",
                                   kPictureFormats));
  return format;
}

Descriptor PictureFile::copy_in_memory(std::uint64_t max_bytes) const {
  if (size_ > max_bytes)
    unreadable_picture(
        path_, fmt::format("the file has {} bytes; at most {} of such a format are read", size_,
                           max_bytes));
  Descriptor copy(::memfd_create("picture", MFD_CLOEXEC));
  if (copy.get() < 0) cannot_open(path_, errno);
  off_t offset = 0;
  while (std::uint64_t(offset) < size_) {
    const ssize_t n = ::sendfile(copy.get(), descriptor(), &offset, std::size_t{1} << 24);
    const int error = errno;
    if (n > 0 && !interrupted()) continue;
    throw_if_interrupted();
    unreadable_picture(path_, n < 0 ? std::strerror(error) : "it became shorter while it was read");
  }
  return copy;
}

}  // namespace lobelia
