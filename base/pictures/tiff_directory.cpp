#include "base/pictures/tiff_directory.hpp"

#include "base/pictures/picture_file.hpp"

namespace lobelia {

std::optional<TiffDirectory> TiffDirectory::first(std::string_view file) {
  const bool little = file.starts_with("II");
  if (file.size() < 8 || (!little && !file.starts_with("MM"))) return std::nullopt;
  const std::uint64_t version = number_at(file, 2, little, 2);
  const bool big = version == 43;
  if (version != 42 && !big) return std::nullopt;
  const TiffDirectory any(file, little, big);
  return any.at(number_at(file, big ? 8 : 4, little, any.offset_size()));
}

std::optional<TiffDirectory> TiffDirectory::at(std::uint64_t place) const {
  constexpr std::uint64_t kMaxEntries = 65535;
  const std::size_t count_size = big_ ? 8 : 2;
  if (place == 0 || place > file_.size() || file_.size() - place < count_size) return std::nullopt;
  TiffDirectory result = *this;
  result.count_ = number_at(file_, place, little_, count_size);
  result.entries_ = place + count_size;
  if (result.count_ > kMaxEntries || file_.size() - result.entries_ < result.count_ * entry_size())
    return std::nullopt;
  return result;
}

std::optional<TiffDirectory> TiffDirectory::next() const {
  const std::uint64_t end = entries_ + count_ * entry_size();
  // The last directory may lack the offset.
  if (file_.size() - end < offset_size()) return std::nullopt;
  return at(number_at(file_, end, little_, offset_size()));
}

std::optional<std::uint64_t> TiffDirectory::place_of(std::uint64_t tag) const {
  for (std::uint64_t i = 0; i < count_; ++i)
    if (const std::uint64_t entry = entries_ + i * entry_size();
        number_at(file_, entry, little_, 2) == tag)
      return entry;
  return std::nullopt;
}

std::optional<std::uint64_t> TiffDirectory::number(std::uint64_t tag) const {
  const auto entry = place_of(tag);
  if (!entry) return std::nullopt;
  constexpr std::size_t kSizes[] = {0, 1, 0, 2, 4};  // of the types BYTE, SHORT and LONG
  const std::uint64_t type = number_at(file_, *entry + 2, little_, 2);
  const std::uint64_t count = number_at(file_, *entry + 4, little_, offset_size());
  if (type >= std::size(kSizes) || kSizes[type] == 0 || count != 1) return std::nullopt;
  return number_at(file_, *entry + 4 + offset_size(), little_, kSizes[type]);
}

}  // namespace lobelia
