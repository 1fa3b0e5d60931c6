// The materials in files of other programs, as highlights that `lobelia convert` can compare.
//
// A value that is missing or cannot be read becomes the default of the file's format, and a remark says so. Parts of a material
// that no highlight here has, such as pictures and Fresnel factors of metals, are remarks too.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/convert/curve.hpp"

namespace lobelia::conversion {

/// Most materials of a file.
inline constexpr std::size_t kMostMaterials = 10'000;

struct FileMaterial {
  /// `text` is untrusted, and `number` counts materials without a name.
  FileMaterial(std::string_view text, std::size_t number);

  /// The highlight of a model of the catalogue, or of "ggx" by its alpha. A remark in its place if the parameter is out of range.
  void set(std::string_view model_name, double value);
  void remark(std::string sentence);

  std::string name;  ///< one line of valid UTF-8
  std::optional<ShadingModel>
      model;             ///< none: there is no highlight to convert, and a remark says why
  double parameter = 0;  ///< exponent, or alpha of ggx
  double f0 = 1;         ///< reflectance head on, over that at grazing angles; 1e-3 to 1
  std::vector<std::string> remarks;
};

struct Assets {
  std::string_view meaning;  ///< of the format's parameters, with the source
  std::vector<FileMaterial> materials = {};
  std::vector<std::string> remarks = {};  ///< on the file

  /// Throws Error(kInput) if there are too many.
  FileMaterial& add(std::string_view name);
};

/// "value" as a number from `least` to `most`; otherwise nothing, and a remark that begins with `what`.
std::optional<double> number_of(std::string_view value, double least, double most,
                                std::string_view what, FileMaterial& material);

/// F0 of a dielectric in air, from its refractive index.
double reflectance_of_ior(double ior);

// ---- a reader for each format. Throw Error(kInput) if the text is not in that format.

Assets read_mtl(const std::string& text);
Assets read_gltf(std::string_view json, const std::string& file_name);
Assets read_povray_finishes(std::string_view text);
Assets read_mitsuba_materials(const std::string& text, const std::string& file_name);

/// The reader goes by the suffix: .mtl, .gltf, .glb, .pov, .inc or .xml (of Mitsuba or of Lobelia). Throws Error(kUsage) for
/// another one, Error(kInput) if the file cannot be read.
Assets read_assets(const std::filesystem::path& path);

}  // namespace lobelia::conversion
