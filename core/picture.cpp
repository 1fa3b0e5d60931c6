#include "core/picture.hpp"

namespace lobelia {

Json to_json(const PixelWindow& window) {
  return {{"x", window.x}, {"y", window.y}, {"width", window.width}, {"height", window.height}};
}

Json to_json(const PictureSource& source) {
  Json json = {{"format", source.format},
               {"layer", source.layer},
               {"channels", source.channels},
               {"valueType", source.value_type},
               {"transfer", source.transfer},
               {"multipliedByAlpha", source.multiplied_by_alpha},
               {"dataWindow", to_json(source.data)},
               {"displayWindow", to_json(source.display)}};
  if (!source.chromaticities.empty()) json["chromaticities"] = source.chromaticities;
  if (!source.icc_profile.empty()) {
    json["iccProfile"] = source.icc_profile;
    json["iccProfileIsSrgb"] = source.icc_is_srgb;
  }
  return json;
}

}  // namespace lobelia
