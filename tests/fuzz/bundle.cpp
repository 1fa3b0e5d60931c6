#include "tests/fuzz/bundle.hpp"

#include <fstream>
#include <stdexcept>

namespace lobelia::fuzz {

std::map<std::string, std::string> files_of_bundle(std::string_view bundle) {
  constexpr std::string_view kMark = "=== ";
  constexpr std::size_t kLongestName = 40;
  std::map<std::string, std::string> files;
  std::string* file = nullptr;
  while (!bundle.empty()) {
    const std::size_t end = std::min(bundle.find('\n'), bundle.size() - 1) + 1;
    const std::string_view line = bundle.substr(0, end);
    bundle.remove_prefix(end);
    if (line.starts_with(kMark) && line.ends_with('\n')) {
      const std::string name(line.substr(kMark.size(), line.size() - kMark.size() - 1));
      if (!name.empty() && name.size() <= kLongestName && name[0] != '.' &&
          name.find_first_of(std::string_view("/\0", 2)) == name.npos) {
        file = &files[name];
        continue;
      }
    }
    if (file) *file += line;
  }
  return files;
}

const std::filesystem::path& scratch() {
  static const TemporaryDirectory directory;
  return directory.path();
}

void write_plainly(const std::filesystem::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), std::streamsize(text.size()));
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot write");
}

}  // namespace lobelia::fuzz
