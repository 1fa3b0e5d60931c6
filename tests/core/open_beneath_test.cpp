#include "core/open_beneath.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "core/files.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// The file's text; "-" and the error's number where it is not opened.
template <class Open>
std::string content(const fs::path& directory, const std::vector<std::string>& names, Open open) {
  const int place = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int file = open(place, names);
  std::string text = "-" + std::to_string(errno);
  if (file >= 0) {
    text.resize(100);
    text.resize(std::size_t(std::max<ssize_t>(0, ::read(file, text.data(), text.size()))));
    ::close(file);
  }
  ::close(place);
  return text;
}

TEST(OpenBeneath, OpensNothingOutside) {
  const TemporaryDirectory directory;
  const fs::path site = directory.path() / "site";
  fs::create_directories(site / "folder");
  write_file(directory.path() / "secret", "secret");
  write_file(site / "folder/file", "file");
  fs::create_symlink("../secret", site / "out");
  fs::create_symlink(directory.path() / "secret", site / "out_absolute");
  fs::create_directory_symlink("..", site / "up");
  fs::create_directory_symlink("folder", site / "link");
  for (const auto open : {open_beneath, open_beneath_by_steps}) {
    const bool by_steps = open == open_beneath_by_steps;
    EXPECT_EQ(content(site, {"folder", "file"}, open), "file");
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"out"}, {"out_absolute"}, {"up", "secret"}, {"link", "none"}})
      EXPECT_TRUE(content(site, names, open).starts_with("-")) << names[0];
    EXPECT_EQ(content(site, {"link", "file"}, open).starts_with("-"), by_steps)
        << "a link that stays inside";
    EXPECT_EQ(content(site, {"none"}, open), "-" + std::to_string(ENOENT));
  }
}

TEST(OpenBeneath, DoesNotWaitForTheWriterOfAPipe) {
  const TemporaryDirectory directory;
  ASSERT_EQ(::mkfifo((directory.path() / "pipe").c_str(), 0600), 0);
  for (const auto open : {open_beneath, open_beneath_by_steps})
    EXPECT_EQ(content(directory.path(), {"pipe"}, open), "");
}

}  // namespace
}  // namespace lobelia
