#include "studies/convert/assets/assets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "renderer/ggx.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::uint64_t kMostAssetBytes = 64 << 20;
constexpr std::size_t kMostRemarks = 20;

constexpr std::string_view kLobeliaMeaning = "Lobelia: model and exponent of each material";

/// The JSON of a binary glTF, which is its first chunk. The others are not read.
std::string json_of_glb(const InputFile& file) {
  constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A;
  std::array<std::uint32_t, 5> head{};  // little-endian, as this program's machines are
  const auto path = printable_path(file.path().string());
  if (read_in_pieces(file.descriptor(), head.data(), sizeof head) < sizeof head ||
      head[0] != kMagic || head[1] != kVersion || head[4] != kJson)
    throw Error(ExitCode::kInput, "{}: not a binary glTF of version 2", path);
  const std::size_t size = head[3];
  if (size > kMostAssetBytes || size + sizeof head > file.size())
    throw Error(ExitCode::kInput, "{}: its JSON has {} bytes; allowed: at most {} and the file's",
                path, size, kMostAssetBytes);
  std::string json(size, ' ');
  if (read_in_pieces(file.descriptor(), json.data(), size, sizeof head) < size)
    throw Error(ExitCode::kInput, "{}: shorter than when it was opened", path);
  return json;
}

Assets read_own_materials(const Scene& scene) {
  Assets assets{kLobeliaMeaning};
  for (const Material& material : scene.materials) {
    FileMaterial& one = assets.add(material.id);
    const Highlight& highlight = material.highlight;
    const std::string_view lobe = info(highlight.lobe).name;
    if (!has_highlight(material)) {
      one.remark("its highlight is black");
    } else if (lobe == "ggx" && info(highlight.model).has_shadowing) {
      one.set("ggx", std::sqrt(alpha_squared(highlight.exponent)));
    } else {
      one.set(info(highlight.model).name, highlight.exponent);
      if (lobe != "cosine")
        one.remark(fmt::format("the lobe {} is converted as the cosine lobe", lobe));
    }
    const Rgb f0 = material.specular_reflectance;
    if (material.fresnel == Fresnel::kNone) continue;
    one.f0 = std::clamp((f0.r + f0.g + f0.b) / 3, 1e-3, 1.0);
  }
  return assets;
}

Assets read_xml(std::string text, const std::filesystem::path& path) {
  const XmlSource xml(text, path.string(), kMaxSceneBytes);
  if (xml.root().attribute("version").value() != kSceneFormatVersion)
    return read_mitsuba_materials(text, path.string());
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  return read_own_materials(parse_scene(std::move(text), path.string(), folder));
}

}  // namespace

FileMaterial::FileMaterial(std::string_view text, std::size_t number)
    : name(text.empty() ? fmt::format("(material {})", number) : printable(text)) {}

void FileMaterial::set(std::string_view model_name, double value) {
  const auto found = find_shading_model(model_name);
  if (found->is_ggx() && value < found->min())
    return remark(fmt::format("alpha {:.4g} is below {:g}: a mirror, which has no highlight", value,
                              found->min()));
  if (!(value >= found->min() && value <= found->max()))
    return remark(fmt::format("{} {:.6g} is outside {:g} to {:g}",
                              found->is_ggx() ? "alpha" : "exponent", value, found->min(),
                              found->max()));
  model = found;
  parameter = value;
}

void FileMaterial::remark(std::string sentence) {
  if (remarks.size() == kMostRemarks || std::ranges::count(remarks, sentence) > 0) return;
  if (remarks.size() + 1 == kMostRemarks) sentence = "further remarks are left out";
  remarks.push_back(std::move(sentence));
}

FileMaterial& Assets::add(std::string_view name) {
  if (materials.size() == kMostMaterials)
    throw Error(ExitCode::kInput, "over {} materials, which are the most of a file",
                kMostMaterials);
  return materials.emplace_back(name, materials.size() + 1);
}

std::optional<double> number_of(std::string_view value, double least, double most,
                                std::string_view what, FileMaterial& material) {
  double number = 0;
  if (parse_number(value, number) && number >= least && number <= most) return number;
  material.remark(fmt::format("{} '{}' is not a number from {:g} to {:g}", what,
                              printable(value, 40), least, most));
  return std::nullopt;
}

double reflectance_of_ior(double ior) {
  const double root = (ior - 1) / (ior + 1);
  return root * root;
}

Assets read_assets(const std::filesystem::path& path) {
  const std::string suffix = lower_case(path.extension().string());
  const auto text = [&] { return read_file(path, kMostAssetBytes); };
  if (suffix == ".gltf") return read_gltf(text(), path.string());
  if (suffix == ".glb") return read_gltf(json_of_glb(InputFile(path)), path.string());
  if (suffix == ".mtl") return read_mtl(text());
  if (suffix == ".pov" || suffix == ".inc") return read_povray_finishes(text());
  if (suffix == ".xml") return read_xml(text(), path);
  throw Error(
      ExitCode::kUsage,
      "{}: the materials of this file are not known; allowed: .mtl, .gltf, .glb, .pov, .inc, .xml, .binary, .bsdf",
      printable_path(path.string()));
}

}  // namespace lobelia::conversion
