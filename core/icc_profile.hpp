// ICC profiles of pictures, by LittleCMS. A part of the image module (core/image_io.hpp).
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "core/picture_colour.hpp"

namespace lobelia {

/// Larger profiles are refused; those of displays and cameras have a few kilobytes, those with tables of colours some
/// megabytes.
inline constexpr std::size_t kMaxProfileBytes = std::size_t{8} << 20;

/// How a picture's values become light by its profile: relative colorimetric, white to white, by LittleCMS in float. A profile
/// of curves and primaries is not clipped: colours outside of Rec. 709 have negative values.
class IccProfile {
 public:
  /// Throws Error(kInput), naming `path`, for a profile that is damaged, too large, or not of RGB or grey, and for a profile
  /// of grey in a picture of colours.
  IccProfile(const std::filesystem::path& path, std::string_view bytes, bool picture_is_grey);
  ~IccProfile();
  IccProfile(IccProfile&&) noexcept;
  IccProfile& operator=(IccProfile&&) noexcept;

  /// Whether it is that of sRGB: the light of grey within 0.002 at three places, that of pure colours within 0.01.
  bool is_srgb() const { return is_srgb_; }
  /// Whether values are light but for their primaries: grey within 1e-4 at three places.
  bool is_linear() const { return is_linear_; }

  /// Makes values from 0 to 1 linear light with Rec. 709 primaries, in place.
  void to_light(Image& image) const;

 private:
  struct Transform;
  std::unique_ptr<Transform> transform_;
  bool is_srgb_ = false, is_linear_ = false;
};

}  // namespace lobelia
