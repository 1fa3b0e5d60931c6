#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/profile/clipping.hpp"
#include "core/error.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/reflector.hpp"
#include "renderer/render_record.hpp"

namespace lobelia {
namespace {

void require_index(const char* what, int index, std::size_t count) {
  if (index < 0 || std::size_t(index) >= count)
    throw Error(ExitCode::kInput,
                count == 0 ? fmt::format("the scene has no {}", what)
                           : fmt::format("the scene has no {} {}: they are counted from 0 to {}",
                                         what, index, count - 1));
}

/// The diffuse base under one light, as the mean of R, G and B; 0 in shadow.
std::vector<double> diffuse_radiance(const Scene& scene, int light, int sphere) {
  const Rgb albedo = scene.materials.at(std::size_t(scene.spheres.at(std::size_t(sphere)).material))
                         .diffuse_reflectance;
  std::vector<double> radiance(std::size_t(scene.film.width) * scene.film.height, 0.0);
  if (is_black(albedo)) return radiance;
  for_each_pixel_of(scene, sphere, [&](std::size_t i, const Hit& hit, Vec3) {
    if (const auto here = light_at(scene, light, hit)) {
      const Rgb reflected = here->irradiance * albedo;
      radiance[i] = dot(hit.normal, here->to_light) * std::numbers::inv_pi *
                    (reflected.r + reflected.g + reflected.b) / 3;
    }
  });
  return radiance;
}

/// The direction on the film of the plane of incidence, towards the light. The plane contains the eye, the sphere's centre
/// and the light: by symmetry the highlight's middle lies in it.
std::optional<FilmPoint> plane_of_incidence(const Scene& scene, int light, int sphere) {
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const Vec3 centre = scene.spheres.at(std::size_t(sphere)).center;
  const Vec3 to_eye = normalize(frame.origin - centre);
  const Vec3 to_light = illuminate(scene.lights.at(std::size_t(light)), centre).to_light;
  const Vec3 normal = cross(to_eye, to_light);
  // The three points lie on a line, within rounding.
  if (!(length(normal) > 1e-9)) return std::nullopt;
  const double x = dot(normal, frame.up), y = dot(normal, frame.right), size = std::hypot(x, y);
  if (!(size > 0)) return std::nullopt;
  return FilmPoint{x / size, y / size};
}

/// A picture without its specks, and where it is clipped.
struct CleanPicture {
  Image image;
  std::vector<Speck> specks;
  ClippedChannels clipped;

  /// Only a highlight that the scene resolves may have specks: a smaller one is one.
  CleanPicture(const Image& picture, const std::vector<std::size_t>& lit, bool resolved)
      : image(picture) {
    Field field = radiance_field(image);
    if (resolved) specks = take_specks(field);
    for (const Speck& speck : specks)
      for (const std::size_t i : speck.pixels)
        std::ranges::fill(image.values().subspan(3 * i, 3), float(field.values[i]));
    clipped = find_clipping(image, largest_values(image, {}), lit);
  }
  PictureFacts facts(const PictureNoise* noise) const {
    PictureFacts facts{.noise = noise, .thorough = true};
    if (!clipped.names().empty())
      for (std::size_t i = 0; i < image.pixel_count(); ++i)
        facts.clipped.push_back(clipped.holds(image, i));
    return facts;
  }
};

/// What was left out of the highlight. Specks are listed that are at least as high as a highlight without a scene has to be.
void add_left_out(records::HighlightFigures& figures, const CleanPicture& picture,
                  const PictureFacts& facts, const HighlightMap& map, double end, double peak) {
  constexpr std::size_t kMostSpecks = 16;
  for (const Speck& speck : picture.specks)
    if (figures.specks.size() < kMostSpecks && speck.value > kLeastShare * peak &&
        map.angle[speck.pixels.front()] < end)
      figures.specks.push_back({{speck.place.x, speck.place.y}, speck.value, speck.pixels.size()});
  records::ClippedPixels clipped{0, picture.clipped.names()};
  for (std::size_t i = 0; i < facts.clipped.size(); ++i)
    clipped.pixels += facts.clipped[i] && map.angle[i] < end;
  if (clipped.pixels > 0) figures.clipped = clipped;
}

}  // namespace

Image analytic_image(const Scene& scene, int sphere) {
  const Reflector reflector(
      scene.materials.at(std::size_t(scene.spheres.at(std::size_t(sphere)).material)));
  Image image(scene.film.width, scene.film.height);
  for_each_pixel_of(scene, sphere, [&](std::size_t i, const Hit& hit, Vec3 to_eye) {
    Rgb radiance;
    for (int light = 0; light < int(scene.lights.size()); ++light)
      if (const auto here = light_at(scene, light, hit))
        radiance = radiance + here->irradiance * reflector.eval(hit.normal, to_eye, here->to_light);
    float* pixel = image.values().data() + 3 * i;
    pixel[0] = float(radiance.r), pixel[1] = float(radiance.g), pixel[2] = float(radiance.b);
  });
  return image;
}

records::Profile profile_scene(const Scene& scene, int light, int sphere, const NamedImages& images,
                               bool thorough, const std::vector<const PictureNoise*>& noise) {
  require_index("light", light, scene.lights.size());
  require_index("sphere", sphere, scene.spheres.size());
  if (!is_delta(scene.lights[std::size_t(light)]))
    throw Error(ExitCode::kInput,
                fmt::format("light {} is an area or an environment; a highlight's profile is of a "
                            "directional or a point light",
                            light));
  require_single_rays(scene, "a highlight's profile");
  for (const auto& [name, image] : images)
    if (image->width() != scene.film.width || image->height() != scene.film.height)
      throw Error(ExitCode::kInput, fmt::format("{} has {} x {} pixels, the scene's film {} x {}",
                                                name, image->width(), image->height(),
                                                scene.film.width, scene.film.height));

  const Material& material =
      scene.materials.at(std::size_t(scene.spheres[std::size_t(sphere)].material));
  const Highlight& highlight = material.highlight;
  const PreparedLobe lobe = prepare(highlight.lobe, highlight.exponent);
  const HighlightMap map = highlight_map(scene, light, sphere);
  const std::vector<double> diffuse = diffuse_radiance(scene, light, sphere);
  ProfileGeometry geometry;
  geometry.angle = map.angle;
  geometry.solid_angle = map.solid_angle;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone)
    geometry.ends[zone] = lobe_angle_at(lobe, kZoneShares[zone]);
  if (has_highlight(material)) {
    geometry.width = map.width;
    geometry.scale = map.scale;
    geometry.base = diffuse;
    geometry.incidence = plane_of_incidence(scene, light, sphere);
    geometry.lobes = {map.reflection, map.half_vector, map.n_dot_l, map.n_dot_v, map.irradiance};
  }

  std::vector<PictureFacts> facts(images.size() + 1);
  std::vector<CleanPicture> clean;
  if (thorough && has_highlight(material)) {
    std::vector<std::size_t> lit;
    std::size_t middle = 0;
    for (std::size_t i = 0; i < map.angle.size(); ++i) {
      if (!std::isnan(map.angle[i])) lit.push_back(i);
      middle += map.angle[i] < geometry.ends.front();
    }
    for (std::size_t k = 0; k < images.size(); ++k) {
      clean.emplace_back(*images[k].second, lit, middle >= kFewestPixelsOfALobe);
      facts[k + 1] = clean[k].facts(k < noise.size() ? noise[k] : nullptr);
    }
  }

  // Subtracts the formula's value for the other lights from every picture: the curve is for one highlight.
  Scene one_light = scene;
  one_light.lights = {scene.lights[std::size_t(light)]};
  const Image analytic = analytic_image(one_light, sphere);
  const Image with_all = scene.lights.size() > 1 ? analytic_image(scene, sphere) : Image();
  std::vector<Image> single;
  NamedImages all{{records::kAnalytic, &analytic}};
  single.reserve(images.size());
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image* image = clean.empty() ? images[k].second : &clean[k].image;
    if (scene.lights.size() > 1) {
      const std::span<float> values = single.emplace_back(*image).values();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] =
            float(double(values[i]) - (double(with_all.values()[i]) - analytic.values()[i]));
      image = &single.back();
    }
    all.emplace_back(images[k].first, image);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 2; k < all.size(); ++k) pairs.emplace_back(1, k);
  for (std::size_t k = 1; k < all.size(); ++k) pairs.emplace_back(k, 0);

  const Profile profile = measure_profile(geometry, all, pairs, facts);
  const bool reflection = info(highlight.model).angle == LobeAngle::kReflection;
  records::Profile record =
      profile_record(profile, light, sphere, reflection ? "reflection" : "half_vector");
  if (has_highlight(material)) {
    record.lobe = highlight_record(highlight);
    // Means of R, G and B, at their largest in the lobe.
    double peak = 0, of_diffuse = 0, of_others = 0;
    for (std::size_t i = 0; i < map.angle.size(); ++i) {
      if (!(map.angle[i] < geometry.ends.back())) continue;
      const double alone = radiance_at(analytic, i);
      peak = std::max(peak, alone - diffuse[i]);
      of_diffuse = std::max(of_diffuse, diffuse[i]);
      if (scene.lights.size() > 1)
        of_others = std::max(of_others, radiance_at(with_all, i) - alone);
    }
    record.subtracted = records::Subtracted{of_diffuse / peak, of_others / peak};
    for (std::size_t k = 0; k < clean.size(); ++k)
      add_left_out(*record.images[k + 1].second.highlight, clean[k], facts[k + 1], map,
                   geometry.ends.back(), peak);
  }
  return record;
}

std::vector<std::pair<int, int>> highlights_of(const Scene& scene) {
  require_single_rays(scene, "a highlight's profile");
  std::vector<std::pair<int, int>> found;
  for (int sphere = 0; sphere < int(scene.spheres.size()); ++sphere) {
    const int material = scene.spheres[std::size_t(sphere)].material;
    if (!has_highlight(scene.materials.at(std::size_t(material)))) continue;
    for (int light = 0; light < int(scene.lights.size()); ++light)
      found.emplace_back(sphere, light);
  }
  return found;
}

}  // namespace lobelia
