#include "renderer/shipped_files.hpp"

#include "base/system/host.hpp"

namespace lobelia {

std::filesystem::path or_shipped(const std::filesystem::path& path) {
  constexpr std::string_view kFolder = "reference_scenes/", kShare = "../share/lobelia/";
  std::error_code error;
  const std::string name = path.string();
  if (!name.starts_with(kFolder) || std::filesystem::exists(path, error)) return path;
  const auto shipped = (own_file().parent_path() / kShare / name.substr(kFolder.size()));
  return std::filesystem::exists(shipped, error) ? shipped.lexically_normal() : path;
}

}  // namespace lobelia
