#include "core/picture.hpp"

namespace lobelia {
namespace {

Json window_json(const PixelWindow& window) {
  return {{"x", window.x}, {"y", window.y}, {"width", window.width}, {"height", window.height}};
}

}  // namespace

Json to_json(const PictureSource& source) {
  Json json = {{"format", source.format},
               {"layer", source.layer},
               {"channels", source.channels},
               {"valueType", source.value_type},
               {"transfer", source.transfer},
               {"multipliedByAlpha", source.multiplied_by_alpha},
               {"dataWindow", window_json(source.data)},
               {"displayWindow", window_json(source.display)}};
  if (!source.icc_profile.empty()) json["iccProfile"] = source.icc_profile;
  return json;
}

}  // namespace lobelia
