// From scene-linear light to a display, by OpenColorIO, and back.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/pictures/image.hpp"

namespace lobelia {

/// The picture on an sRGB display: values times 2^exposure_stops, clipped to [0, 1], encoded
/// by the sRGB display of base/pictures/lobelia.ocio, rounded to 8 bits. Non-finite pixels become magenta.
DisplayImage to_display(const Image& image, double exposure_stops);
/// The same for rows of a picture, 3 * width floats each.
DisplayImage to_display(std::span<const float> rows, int width, double exposure_stops);

/// An sRGB-encoded value (IEC 61966-2-1) as linear light.
float srgb_decoded(float value);
/// Linear light as sRGB encodes it, and on above 1.
double srgb_encoded(double light);

/// The exposure, in stops, that brings `peak` to display white; 0 if peak is not a positive number.
double exposure_for_peak(double peak);

/// An OpenColorIO configuration and a view in it. Empty texts mean its defaults.
struct DisplayViewChoice {
  std::string config;  ///< a file or kOwnConfig; empty: $OCIO, else Lobelia's own
  std::string display, view;
  /// The colour space of our pictures: a name, an alias or a role. The default is linear Rec. 709 by one of its usual
  /// names, else the role scene_linear.
  std::string input_space;

  bool operator==(const DisplayViewChoice&) const = default;
};
inline constexpr char kOwnConfig[] = "builtin";

/// A display's view of a scene by an OpenColorIO configuration.
class DisplayView {
 public:
  /// Null for Lobelia's own sRGB display, which needs no OpenColorIO. Throws Error(kInput) for a configuration that
  /// cannot be read or used, Error(kUsage) for a display, view or colour space that it lacks, naming those it has.
  static std::shared_ptr<const DisplayView> open(const DisplayViewChoice& choice);
  virtual ~DisplayView() = default;

  /// The display's linear light in Rec. 709 primaries, clipped to [0, 1], 1 for its white: `scene_linear` times
  /// 2^exposure_stops, through the view, decoded again.
  virtual Image shown(const Image& scene_linear, double exposure_stops) const = 0;

  /// With the names of all defaults.
  const DisplayViewChoice& choice() const { return choice_; }
  /// OpenColorIO's hash of the configuration: two files with one hash show the same.
  const std::string& config_id() const { return config_id_; }
  /// "XYZ" if the configuration defines the display's light; "sRGB" if not, and its values are decoded as sRGB.
  const std::string& decoded_by() const { return decoded_by_; }

 protected:
  DisplayView() = default;
  DisplayViewChoice choice_;
  std::string config_id_, decoded_by_;
};

}  // namespace lobelia
