// What a display shows of a scene by an OpenColorIO configuration: the user's, or Lobelia's own.
#pragma once

#include <memory>
#include <string>

#include "core/image.hpp"

namespace lobelia {

/// Which configuration, and what of it; empty: its default.
struct DisplayViewChoice {
  std::string config;  ///< a file, kOwnConfig, or empty: $OCIO, and without that Lobelia's own
  std::string display, view;
  /// The colour space of our pictures: a name, an alias or a role. By default the configuration's linear
  /// Rec. 709 by one of the names that it goes by, or else its role scene_linear.
  std::string input_space;

  bool operator==(const DisplayViewChoice&) const = default;
};
inline constexpr char kOwnConfig[] = "builtin";

class DisplayView {
 public:
  /// Null where nothing but Lobelia's own sRGB display was chosen, and $OCIO says nothing else: what that
  /// shows needs no OpenColorIO. Throws Error(kInput) for a configuration that cannot be read or used,
  /// Error(kUsage) for a display, view or colour space that it does not have, with those it has.
  static std::shared_ptr<const DisplayView> open(const DisplayViewChoice& choice);
  ~DisplayView();

  /// Linear light of the display in Rec. 709 primaries, 1 for its white, clipped to [0, 1]: `scene_linear`
  /// times 2^exposure_stops, through the view, and decoded again.
  Image shown(const Image& scene_linear, double exposure_stops) const;

  /// All names in full, and how the display's values are decoded.
  const DisplayViewChoice& choice() const { return choice_; }
  /// The configuration's hash, by OpenColorIO: two files with one hash show the same.
  const std::string& config_id() const { return config_id_; }
  /// "XYZ" where the configuration says what light the display gives; "sRGB" where it does not, and its
  /// values are taken for sRGB's.
  const std::string& decoded_by() const { return decoded_by_; }

 private:
  struct Processors;
  DisplayView();
  DisplayViewChoice choice_;
  std::string config_id_, decoded_by_;
  std::unique_ptr<Processors> processors_;
};

}  // namespace lobelia
