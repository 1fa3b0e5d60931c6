#include "core/icc_profile.hpp"

#include <fmt/format.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/colour.hpp"
#include "core/picture_file.hpp"

namespace lobelia {
namespace {

template <auto close>
struct Closer {
  template <class Handle>
  void operator()(Handle* handle) const {
    close(handle);
  }
};
using Profile = std::unique_ptr<void, Closer<&cmsCloseProfile>>;

/// Keeps the first message of a context.
void keep_message(cmsContext context, cmsUInt32Number, const char* text) {
  auto& message = *static_cast<std::string*>(cmsGetContextUserData(context));
  if (message.empty()) message = text;
}

Profile linear_rec709(cmsContext context) {
  const auto& c = kRec709Chromaticities;
  const cmsCIExyY white{c[6], c[7], 1};
  const cmsCIExyYTRIPLE primaries{{c[0], c[1], 1}, {c[2], c[3], 1}, {c[4], c[5], 1}};
  cmsToneCurve* const line = cmsBuildGamma(context, 1);
  cmsToneCurve* curves[] = {line, line, line};
  Profile result(cmsCreateRGBProfileTHR(context, &white, &primaries, curves));
  cmsFreeToneCurve(line);
  return result;
}

}  // namespace

struct IccProfile::Transform {
  std::string message;
  std::unique_ptr<_cmsContext_struct, Closer<&cmsDeleteContext>> context;
  std::unique_ptr<void, Closer<&cmsDeleteTransform>> handle;
  bool is_grey = false;
};

IccProfile::IccProfile(const std::filesystem::path& path, std::string_view bytes,
                       bool picture_is_grey)
    : transform_(std::make_unique<Transform>()) {
  if (bytes.size() > kMaxProfileBytes)
    unreadable_picture(path, fmt::format("its ICC profile has {} bytes; at most {} are read",
                                         bytes.size(), kMaxProfileBytes));
  transform_->context.reset(cmsCreateContext(nullptr, &transform_->message));
  cmsContext const context = transform_->context.get();
  cmsSetLogErrorHandlerTHR(context, keep_message);
  const Profile profile(
      cmsOpenProfileFromMemTHR(context, bytes.data(), std::uint32_t(bytes.size())));
  const auto damaged = [&] {
    unreadable_picture(
        path, fmt::format("its ICC profile is damaged{}{}", transform_->message.empty() ? "" : ": ",
                          transform_->message));
  };
  if (!profile) damaged();
  const cmsColorSpaceSignature space = cmsGetColorSpace(profile.get());
  transform_->is_grey = space == cmsSigGrayData;
  if (!transform_->is_grey && space != cmsSigRgbData)
    unreadable_picture(path, "its ICC profile is not of RGB or grey");
  if (transform_->is_grey && !picture_is_grey)
    unreadable_picture(path, "its ICC profile is of grey, but it has colours");
  const Profile light = linear_rec709(context);
  transform_->handle.reset(cmsCreateTransformTHR(
      context, profile.get(), transform_->is_grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, light.get(),
      TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE));
  if (!transform_->handle) damaged();

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
      value = transform_->is_grey ? same : double(probe.pixel(int(3 + column), 0)[row]);
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

IccProfile::~IccProfile() = default;
IccProfile::IccProfile(IccProfile&&) noexcept = default;
IccProfile& IccProfile::operator=(IccProfile&&) noexcept = default;

void IccProfile::to_light(Image& image) const {
  const auto width = std::size_t(image.width());
  std::vector<float> row(3 * width);
  for (int y = 0; y < image.height(); ++y) {
    float* const values = image.pixel(0, y).data();
    if (transform_->is_grey)
      for (std::size_t x = 0; x < width; ++x) row[x] = values[3 * x];
    else
      std::copy_n(values, 3 * width, row.begin());
    cmsDoTransform(transform_->handle.get(), row.data(), values, std::uint32_t(width));
  }
}

}  // namespace lobelia
