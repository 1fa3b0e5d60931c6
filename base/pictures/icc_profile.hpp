// ICC profiles of pictures, by LittleCMS. A part of the image module (base/pictures/image_io.hpp).
#pragma once

#include <fmt/format.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/colour.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/pictures/picture_file.hpp"

namespace lobelia {

/// Larger profiles are refused; those of displays and cameras have a few kilobytes, those with tables of colours some
/// megabytes.
inline constexpr std::size_t kMaxProfileBytes = std::size_t{8} << 20;

/// How a picture's values become light by its profile: relative colorimetric, white to white, by LittleCMS in float. A
/// profile of curves and primaries is not clipped: colours outside of Rec. 709 have negative values.
class IccProfile {
 public:
  /// Throws Error(kInput), naming `path`, for a profile that is damaged, too large, or not of RGB or grey, and for a profile
  /// of grey in a picture of colours.
  IccProfile(const std::filesystem::path& path, std::string_view bytes, bool picture_is_grey) {
    if (bytes.size() > kMaxProfileBytes)
      unreadable_picture(path, fmt::format("its ICC profile has {} bytes; at most {} are read",
                                           bytes.size(), kMaxProfileBytes));
    context_.reset(cmsCreateContext(nullptr, message_.get()));
    cmsContext const context = context_.get();
    cmsSetLogErrorHandlerTHR(context, keep_message);
    const Profile profile(
        cmsOpenProfileFromMemTHR(context, bytes.data(), std::uint32_t(bytes.size())));
    const auto damaged = [&] {
      unreadable_picture(path, fmt::format("its ICC profile is damaged{}{}",
                                           message_->empty() ? "" : ": ", *message_));
    };
    if (!profile) damaged();
    const cmsColorSpaceSignature space = cmsGetColorSpace(profile.get());
    is_grey_ = space == cmsSigGrayData;
    if (!is_grey_ && space != cmsSigRgbData)
      unreadable_picture(path, "its ICC profile is not of RGB or grey");
    if (is_grey_ && !picture_is_grey)
      unreadable_picture(path, "its ICC profile is of grey, but it has colours");
    const Profile light = linear_rec709(context);
    handle_.reset(cmsCreateTransformTHR(
        context, profile.get(), is_grey_ ? TYPE_GRAY_FLT : TYPE_RGB_FLT, light.get(), TYPE_RGB_FLT,
        INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE));
    if (!handle_) damaged();

    // The kind of profile, by its result for three greys and the pure colours.
    constexpr float kGreys[] = {0.1f, 0.5f, 0.9f};
    Image probe(6, 1);
    for (int i = 0; i < 3; ++i) {
      std::ranges::fill(probe.pixel(i, 0), kGreys[i]);
      probe.pixel(3 + i, 0)[std::size_t(i)] = 1;
    }
    to_light(probe);
    for (const float value : probe.values())
      if (!std::isfinite(value)) damaged();
    const auto are_near = [&](auto curve, double by) {
      for (int i = 0; i < 3; ++i)
        for (const float value : probe.pixel(i, 0))
          if (!(std::abs(double(value) - double(curve(kGreys[i]))) < by)) return false;
      return true;
    };
    bool is_rec709 = true;
    RgbMatrix m;  // by columns the light of pure red, green and blue
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t row = 0; row < 3; ++row) {
        const double same = row == column ? 1 : 0;
        double& value = m[row][column];
        value = is_grey_ ? same : double(probe.pixel(int(3 + column), 0)[row]);
        is_rec709 = is_rec709 && std::abs(value - same) < 0.01;
      }
    // As primaries on a line would, a profile without a curve or a colour shows many colours as one.
    const double volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    constexpr double kLeastVolume = 1e-3, kLeastStep = 1e-4;
    const float dark = probe.pixel(0, 0)[1], middle = probe.pixel(1, 0)[1],
                bright = probe.pixel(2, 0)[1];
    if (std::abs(volume) < kLeastVolume || std::abs(middle - dark) < kLeastStep ||
        std::abs(bright - middle) < kLeastStep)
      unreadable_picture(path, "its ICC profile shows different colours as one");
    is_srgb_ = is_rec709 && are_near(srgb_decoded, 0.002);
    is_linear_ = are_near([](float value) { return value; }, 1e-4);
  }

  /// Whether it is that of sRGB: the light of grey within 0.002 at three places, that of pure colours within 0.01.
  bool is_srgb() const { return is_srgb_; }
  /// Whether values are light but for their primaries: grey within 1e-4 at three places.
  bool is_linear() const { return is_linear_; }

  /// Makes values from 0 to 1 linear light with Rec. 709 primaries, in place.
  void to_light(Image& image) const {
    const auto width = std::size_t(image.width());
    std::vector<float> row(3 * width);
    for (int y = 0; y < image.height(); ++y) {
      float* const values = image.pixel(0, y).data();
      if (is_grey_)
        for (std::size_t x = 0; x < width; ++x) row[x] = values[3 * x];
      else
        std::copy_n(values, 3 * width, row.begin());
      cmsDoTransform(handle_.get(), row.data(), values, std::uint32_t(width));
    }
  }

 private:
  template <auto close>
  struct Closer {
    template <class Handle>
    void operator()(Handle* handle) const {
      close(handle);
    }
  };
  using Profile = std::unique_ptr<void, Closer<&cmsCloseProfile>>;

  /// Keeps the first message of a context.
  static void keep_message(cmsContext context, cmsUInt32Number, const char* text) {
    auto& message = *static_cast<std::string*>(cmsGetContextUserData(context));
    if (message.empty()) message = text;
  }

  static Profile linear_rec709(cmsContext context) {
    const auto& c = kRec709Chromaticities;
    const cmsCIExyY white{c[6], c[7], 1};
    const cmsCIExyYTRIPLE primaries{{c[0], c[1], 1}, {c[2], c[3], 1}, {c[4], c[5], 1}};
    cmsToneCurve* const line = cmsBuildGamma(context, 1);
    cmsToneCurve* curves[] = {line, line, line};
    Profile result(cmsCreateRGBProfileTHR(context, &white, &primaries, curves));
    cmsFreeToneCurve(line);
    return result;
  }

  std::unique_ptr<std::string> message_ = std::make_unique<std::string>();  ///< of the context
  std::unique_ptr<_cmsContext_struct, Closer<&cmsDeleteContext>> context_;
  std::unique_ptr<void, Closer<&cmsDeleteTransform>> handle_;
  bool is_grey_ = false, is_srgb_ = false, is_linear_ = false;
};

}  // namespace lobelia
