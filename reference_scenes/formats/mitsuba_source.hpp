// A scene file of Mitsuba as XML, with its parameters filled in and its transforms worked out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/words/vec.hpp"
#include "renderer/scene/element_reader.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

/// An affine map: the images of the axes and of the origin.
struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

  Vec3 of_vector(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3 of_point(Vec3 p) const { return of_vector(p) + origin; }
  /// First `first`, then this one.
  Affine after(const Affine& first) const {
    return {of_vector(first.x), of_vector(first.y), of_vector(first.z), of_point(first.origin)};
  }
};

struct LookAt {
  Vec3 origin, target, up;
};

/// <transform name="to_world">.
struct Transform {
  Affine matrix;
  bool is_identity = true;
  std::optional<LookAt> lookat;  ///< if it is nothing else
};

class MitsubaSource {
 public:
  /// Throws Error(kInput) as XmlSource, and unless the root is a <scene>. Fills in the $parameters by their <default>,
  /// writes names of versions before 2 as later ones (toWorld is to_world), and drops parameters that change no picture
  /// of ours.
  MitsubaSource(std::string text, std::string file_name);

  XmlSource& xml() { return xml_; }
  ElementReader& reader() { return reader_; }
  pugi::xml_node root() const { return xml_.root(); }
  bool is_old() const { return is_old_; }

  static std::string_view type(pugi::xml_node element) { return element.attribute("type").value(); }
  /// Notes that the element is not supported, and what becomes of it: "it is left out".
  void unsupported(pugi::xml_node element, std::string_view instead);
  /// The parameters of an element, with Mitsuba's default for each that is missing or cannot be read.
  Values values(pugi::xml_node element, std::span<const Parameter> table,
                ElementReader::Tags nested = {});

  /// The element's to_world; the identity without one. Nothing after an error.
  std::optional<Transform> transform(pugi::xml_node element);
  /// The value of <boolean name="...">, false without one.
  bool flag(pugi::xml_node element, std::string_view name);

 private:
  void read_defaults();
  void prepare(pugi::xml_node node, int depth);
  void fill_in(pugi::xml_node node, pugi::xml_attribute attribute);
  /// Makes linear numbers of <srgb> and of "#ff8000", which stands for sRGB in any colour.
  void read_colour(pugi::xml_node node);
  std::optional<Affine> step(pugi::xml_node node, std::optional<LookAt>& lookat);
  std::optional<Vec3> triple(pugi::xml_node node, const char* attribute);
  std::optional<Vec3> components(pugi::xml_node node, double otherwise);
  std::optional<double> number(pugi::xml_node node, std::string_view text);

  XmlSource xml_;
  ElementReader reader_{xml_};
  bool is_old_ = false;                          ///< of a version before 2
  std::map<std::string, std::string> defaults_;  ///< by "$name"
};

/// Reads camera, film, filter and sampler. Whether the camera could be read.
bool read_mitsuba_sensor(MitsubaSource& file, pugi::xml_node sensor, Scene& scene);

}  // namespace lobelia
