#include "gallery/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/sha256.hpp"
#include "gallery/picture.hpp"
#include "records/record.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

std::size_t count_nonfinite_pixels(const Image& image) {
  std::size_t count = 0;
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); i += 3)
    count += !std::all_of(&values[i], &values[i] + 3, [](float v) { return std::isfinite(v); });
  return count;
}

/// Why it is not even a whole file of its kind; empty if it is one. Looked at only where the hash is another.
std::string damage_of(const fs::path& directory, const std::string& file) {
  try {
    if (file.ends_with(".png")) return look_at_picture(directory, file).why_not;
    if (file.ends_with(".exr")) {
      const std::size_t count = count_nonfinite_pixels(read_image(directory / file));
      if (count > 0)
        return fmt::format("{} has {} {} that {} not finite.", file, count,
                           count == 1 ? "pixel" : "pixels", count == 1 ? "is" : "are");
    }
    if (file.ends_with(".json") &&
        !records::is_json(read_file(directory / file, records::kMaxRecordBytes)))
      return file + " is not JSON.";
    return "";
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return file + " cannot be read: it is damaged or incomplete.";
  }
}

/// Empty for a file that cannot be read.
std::string hash_now(const fs::path& path) {
  try {
    return hex(sha256_of_file(path));
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return "";
  }
}

std::string shortened(const std::string& hash) { return hash.substr(0, 12) + "…"; }

}  // namespace

Evidence::Evidence(fs::path directory, const std::vector<records::CellFile>& files)
    : directory_(std::move(directory)) {
  for (const auto& [file, sealed] : files) {
    if (!hashes_.emplace(file, sealed).second)
      throw Error(ExitCode::kInput, fmt::format("cell.json: files: {} stands there twice", file));
    std::error_code ignored;
    if (!fs::is_regular_file(directory_ / file, ignored)) {
      flaws_.push_back({file, CellStatus::kLost, file + " is missing."});
      continue;
    }
    const std::string now = hash_now(directory_ / file);
    if (now == sealed) continue;
    const std::string damage = damage_of(directory_, file);
    if (damage.empty())
      flaws_.push_back({file, CellStatus::kChanged,
                        fmt::format("{} is not the file that the farm wrote (SHA-256 {}, was {}).",
                                    file, shortened(now), shortened(sealed))});
    else
      flaws_.push_back({file, CellStatus::kDamaged, damage});
  }
}

std::string Evidence::hash_of(const std::string& file) const {
  const auto at = hashes_.find(file);
  return at == hashes_.end() ? hex(sha256_of_file(directory_ / file)) : at->second;
}

}  // namespace lobelia::gallery
