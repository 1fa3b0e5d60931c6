// Reads the materials of Wavefront's MTL.
//
// Source: Wavefront, "Advanced Visualizer Manual", appendix B1: illum 2 adds Ks (H.Hj)^Ns, Hj the half vector, Ns from 0 to
//         1000. Without a factor and without N.L. Pr is of Clara.io's extension for physically based rendering.
#include <fmt/format.h>

#include "base/words/text.hpp"
#include "studies/convert/assets/assets.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kMtlMeaning =
    "MTL: Ns is the exponent of N.H without the cosine N.L (illum 2 of Wavefront's specification)";

struct MtlValues {
  std::optional<double> exponent, roughness;
};

void finish_mtl(FileMaterial& material, const MtlValues& values) {
  if (values.exponent) {
    material.set("blinn_phong_rdf", *values.exponent);
    if (values.roughness)
      material.remark(
          fmt::format("Pr {:g} is a roughness of GGX besides; Ns is converted", *values.roughness));
  } else if (values.roughness) {
    material.set("ggx", *values.roughness * *values.roughness);
    material.remark("Ns is missing: alpha is the square of Pr");
  } else {
    material.remark("Ns is missing, and MTL has no default for it");
  }
}

/// A statement that tells of the highlight; all others are about other parts of a material.
void read_mtl_statement(std::string_view key, const std::string& value, FileMaterial& material,
                        MtlValues& values) {
  if (key == "Ns") {
    values.exponent = number_of(value, 0, kMaxExponent, key, material);
  } else if (key == "Pr") {
    values.roughness = number_of(value, 0, 1, key, material);
  } else if (key == "map_Ns" || key == "map_Pr") {
    material.remark(fmt::format("{} names a picture, which is not read", key));
  } else if (key == "illum" && (value == "0" || value == "1")) {
    material.remark(fmt::format("illum {} shows no highlight", value));
  } else if (key == "Pm" || key == "Ps" || key == "Pc" || key == "aniso") {
    material.remark(fmt::format("{} is not read", key));
  } else if (key == "Ks") {
    const auto parts = split(value.substr(0, 256), " \t");
    double sum = 0, part = 0;
    for (const std::string& text : parts) sum += parse_number(text, part) ? std::abs(part) : 1;
    if (sum == 0) material.remark("Ks is black: the highlight is not seen");
  }
}

}  // namespace

Assets read_mtl(const std::string& text) {
  Assets assets{kMtlMeaning};
  MtlValues values;
  const auto finish = [&] {
    if (!assets.materials.empty()) finish_mtl(assets.materials.back(), values);
    values = {};
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    line = line.substr(std::min(line.find_first_not_of(" \t\r"), line.size()));
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    const std::size_t gap = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view key = line.substr(0, gap);
    const std::size_t rest = std::min(line.find_first_not_of(" \t", gap), line.size());
    if (key == "newmtl") {
      finish();
      if (assets.add(line.substr(rest)); rest == line.size())
        assets.materials.back().remark("newmtl has no name");
    } else if (!assets.materials.empty()) {
      read_mtl_statement(key, std::string(line.substr(rest)), assets.materials.back(), values);
    } else if (key == "Ns") {
      assets.remarks = {"Ns before the first newmtl is left out"};
    }
  }
  finish();
  return assets;
}

}  // namespace lobelia::conversion
