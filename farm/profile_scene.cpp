#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/system/error.hpp"
#include "profile/clipping.hpp"
#include "profile/stored_steps.hpp"
#include "renderer/chord.hpp"
#include "renderer/filter.hpp"
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

/// One sphere of a scene under its lights, each pixel seen through the film's filter. Scenes as require_single_rays() takes
/// them; the scene has to outlive this object.
class PixelMeans {
 public:
  /// `of_means`: with the film's filter, otherwise at the pixels' centres alone.
  PixelMeans(const Scene& scene, int sphere, bool of_means)
      : scene_(scene),
        sphere_(sphere),
        frame_(camera_frame(scene.camera, scene.film)),
        reflector_(scene.materials.at(std::size_t(scene.spheres.at(std::size_t(sphere)).material))),
        nodes_(of_means ? filter_nodes(scene.film.filter)
                        : std::vector<FilterNode>{{.x = 0, .y = 0, .weight = 1}}),
        reach_(of_means ? scene.film.filter.radius : 0) {}

  std::size_t nodes_per_pixel() const { return nodes_.size(); }
  /// Whether all of what the filter sees of a pixel is the sphere, lit by `light`.
  bool is_whole(std::size_t pixel, int light) const {
    const auto is_lit = [&](double x, double y) {
      const auto seen = at(pixel, x, y);
      return seen && light_at(scene_, light, seen->hit);
    };
    return is_lit(0, 0) && (reach_ == 0 || (is_lit(-reach_, -reach_) && is_lit(reach_, -reach_) &&
                                            is_lit(-reach_, reach_) && is_lit(reach_, reach_)));
  }
  /// The geometry of the highlight of `light`; no nodes if the pixel is not whole.
  PixelMean highlight(std::size_t pixel, int light) const {
    PixelMean mean;
    if (!is_whole(pixel, light)) return mean;
    for (const FilterNode& node : nodes_) {
      const auto seen = at(pixel, node.x, node.y);
      const auto place = seen ? highlight_at(scene_, light, seen->hit, seen->to_eye) : std::nullopt;
      if (!place) return {};
      mean.nodes.push_back({node.weight, place->reflection, place->half_vector, place->n_dot_l,
                            place->n_dot_v, place->irradiance});
      mean.of_lobe.push_back({place->angle, node.weight * place->scale});
    }
    return mean;
  }
  /// The diffuse radiance under a light, the mean of R, G and B.
  double diffuse(std::size_t pixel, int light) const {
    const Rgb albedo = scene_.materials[std::size_t(scene_.spheres[std::size_t(sphere_)].material)]
                           .diffuse_reflectance;
    if (is_black(albedo)) return 0;
    double sum = 0;
    for (const FilterNode& node : nodes_) {
      const auto seen = at(pixel, node.x, node.y);
      const auto here = seen ? light_at(scene_, light, seen->hit) : std::nullopt;
      if (!here) continue;
      const Rgb reflected = here->irradiance * albedo;
      sum += node.weight * dot(seen->hit.normal, here->to_light) * std::numbers::inv_pi *
             (reflected.r + reflected.g + reflected.b) / 3;
    }
    return sum;
  }
  /// The radiance under one light, or all if none is named. Where the sphere is not seen it is 0.
  Rgb radiance(std::size_t pixel, std::optional<int> light) const {
    Rgb sum;
    for (const FilterNode& node : nodes_) {
      const auto seen = at(pixel, node.x, node.y);
      if (!seen) continue;
      for (int k = light.value_or(0); k < (light ? *light + 1 : int(scene_.lights.size())); ++k)
        if (const auto here = light_at(scene_, k, seen->hit))
          sum =
              sum + node.weight * (here->irradiance *
                                   reflector_.eval(seen->hit.normal, seen->to_eye, here->to_light));
    }
    return sum;
  }

 private:
  struct Seen {
    Hit hit;
    Vec3 to_eye;
  };
  /// The sphere at a place from a pixel's centre.
  std::optional<Seen> at(std::size_t pixel, double x, double y) const {
    const auto width = std::size_t(scene_.film.width);
    const Vec3 direction = normalize(
        film_ray(frame_, double(pixel % width) + 0.5 + x, double(pixel / width) + 0.5 + y));
    // Most places miss this sphere and need no test of the others.
    const Sphere& wanted = scene_.spheres[std::size_t(sphere_)];
    if (!(chord_of(wanted, frame_.origin, direction).half_squared > 0)) return std::nullopt;
    const auto hit = nearest_hit(scene_, frame_.origin, direction);
    if (!hit || hit->sphere != sphere_) return std::nullopt;
    return Seen{*hit, -direction};
  }

  const Scene& scene_;
  int sphere_;
  CameraFrame frame_;
  Reflector reflector_;
  std::vector<FilterNode> nodes_;
  double reach_ = 0;  ///< of the filter, pixels
};

/// Pictures by a scene's formula of one sphere, under one light and under all.
struct FormulaPictures {
  Image analytic;               ///< under the one light
  Image with_all;               ///< none if it is the only one
  std::vector<double> diffuse;  ///< of the one light, the mean of R, G and B

  FormulaPictures(const Scene& scene, const PixelMeans& means, int light)
      : analytic(scene.film.width, scene.film.height), diffuse(analytic.pixel_count()) {
    if (scene.lights.size() > 1) with_all = Image(scene.film.width, scene.film.height);
    for (std::size_t i = 0; i < diffuse.size(); ++i) {
      set(analytic, i, means.radiance(i, light));
      if (with_all.pixel_count() > 0) set(with_all, i, means.radiance(i, std::nullopt));
      diffuse[i] = means.diffuse(i, light);
    }
  }
  double others(std::size_t pixel) const {
    return with_all.pixel_count() > 0 ? radiance_at(with_all, pixel) - radiance_at(analytic, pixel)
                                      : 0;
  }
  static void set(Image& image, std::size_t pixel, Rgb radiance) {
    float* to = image.values().data() + 3 * pixel;
    to[0] = float(radiance.r), to[1] = float(radiance.g), to[2] = float(radiance.b);
  }
};

/// Where the formula's highlight is brightest; NaN if it is nowhere.
FilmPoint middle_of(const FormulaPictures& formula, const HighlightMap& map) {
  Field field{map.width, map.height, map.angle};
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (!std::isnan(field.values[i]))
      field.values[i] = radiance_at(formula.analytic, i) - formula.diffuse[i];
  return locate_peak(field).place;
}

/// Only pixels that show nothing but the lit sphere have a mean of its highlight.
void leave_whole_pixels(HighlightMap& map, const PixelMeans& means, int light) {
  for (std::size_t i = 0; i < map.angle.size(); ++i)
    if (!std::isnan(map.angle[i]) && !means.is_whole(i, light)) map.angle[i] = kNaN;
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
  StoredSteps steps;

  /// Only a highlight that the scene resolves may have specks: a smaller one is one.
  CleanPicture(const Image& picture, const std::vector<std::size_t>& lit, bool resolved)
      : image(picture), steps(picture) {
    Field field = radiance_field(image);
    if (resolved) specks = take_specks(field);
    for (const Speck& speck : specks)
      for (const std::size_t i : speck.pixels)
        std::ranges::fill(image.values().subspan(3 * i, 3), float(field.values[i]));
    clipped = find_clipping(image, largest_values(image, {}), steps, lit);
  }
  PictureFacts facts(const PictureNoise* noise) const {
    PictureFacts facts{.noise = noise, .thorough = true};
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
      facts.rounding.push_back(steps.rounding(image, i));
    if (!clipped.names().empty())
      for (std::size_t i = 0; i < image.pixel_count(); ++i)
        facts.clipped.push_back(clipped.holds(image, i));
    return facts;
  }
};

/// Adds the specks and clipped pixels that were left out. Specks need the least height of a highlight without a scene.
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
  const PixelMeans centres(scene, sphere, false);
  Image image(scene.film.width, scene.film.height);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    FormulaPictures::set(image, i, centres.radiance(i, std::nullopt));
  return image;
}

records::Profile profile_scene(const Scene& scene, int light, int sphere, const NamedImages& images,
                               bool thorough, const std::vector<const PictureNoise*>& noise,
                               std::optional<PixelsShow> shown) {
  PixelsShow show =
      shown.value_or(scene.sampler.sample_count > 1 ? PixelsShow::kMeans : PixelsShow::kUnknown);
  // Only a fit of lobes can tell.
  if (!thorough && show == PixelsShow::kUnknown) show = PixelsShow::kCentres;
  require_index("light", light, scene.lights.size());
  require_index("sphere", sphere, scene.spheres.size());
  if (!is_delta(scene.lights[std::size_t(light)]))
    throw Error(ExitCode::kInput,
                "light {} is an area or an environment; a highlight's profile is of a "
                "directional or a point light",
                light);
  require_single_rays(scene, "a highlight's profile");
  for (const auto& [name, image] : images)
    if (image->width() != scene.film.width || image->height() != scene.film.height)
      throw Error(ExitCode::kInput, "{} has {} x {} pixels, the scene's film {} x {}", name,
                  image->width(), image->height(), scene.film.width, scene.film.height);

  const Material& material =
      scene.materials.at(std::size_t(scene.spheres[std::size_t(sphere)].material));
  const Highlight& highlight = material.highlight;
  const PreparedLobe lobe = prepare(highlight.lobe, highlight.exponent);
  const PixelMeans centres(scene, sphere, show == PixelsShow::kMeans);
  const PixelMeans means(scene, sphere, true);
  HighlightMap map = highlight_map(scene, light, sphere);
  if (show == PixelsShow::kMeans) leave_whole_pixels(map, means, light);
  const FormulaPictures formula(scene, centres, light);
  ProfileGeometry geometry;
  geometry.angle = map.angle;
  geometry.solid_angle = map.solid_angle;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone)
    geometry.ends[zone] = lobe_angle_at(lobe, kZoneShares[zone]);
  if (has_highlight(material)) {
    geometry.width = map.width;
    geometry.scale = map.scale;
    geometry.base = formula.diffuse;
    geometry.incidence = plane_of_incidence(scene, light, sphere);
    geometry.lobes = {map.reflection, map.half_vector, map.n_dot_l, map.n_dot_v, map.irradiance};
    geometry.middle = middle_of(formula, map);
    geometry.pixels = show;
    geometry.nodes_per_pixel = means.nodes_per_pixel();
    geometry.mean = [&, show](std::size_t pixel) {
      PixelMean mean = means.highlight(pixel, light);
      // If means are known to be shown, what was taken away was a mean too.
      if (show == PixelsShow::kUnknown && !mean.nodes.empty()) {
        const Rgb all = means.radiance(pixel, std::nullopt), one = means.radiance(pixel, light);
        const double others = (all.r - one.r + all.g - one.g + all.b - one.b) / 3;
        mean.more_beneath =
            others + means.diffuse(pixel, light) - formula.others(pixel) - formula.diffuse[pixel];
      }
      return mean;
    };
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
  std::vector<Image> single;
  NamedImages all{{records::kAnalytic, &formula.analytic}};
  single.reserve(images.size());
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image* image = clean.empty() ? images[k].second : &clean[k].image;
    if (scene.lights.size() > 1) {
      const std::span<float> values = single.emplace_back(*image).values();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(double(values[i]) - (double(formula.with_all.values()[i]) -
                                               double(formula.analytic.values()[i])));
      image = &single.back();
    }
    all.emplace_back(images[k].first, image);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 2; k < all.size(); ++k) pairs.emplace_back(1, k);
  for (std::size_t k = 1; k < all.size(); ++k) pairs.emplace_back(k, 0);

  const Profile profile = measure_profile(geometry, all, pairs, facts);
  // Then the formula is to be a mean too.
  if (show == PixelsShow::kUnknown && !images.empty() && !profile.figures.empty() &&
      std::all_of(profile.figures.begin() + 1, profile.figures.end(),
                  [](const HighlightFigures& one) { return one.pixels == PixelsShow::kMeans; }))
    return profile_scene(scene, light, sphere, images, thorough, noise, PixelsShow::kMeans);
  const bool reflection = info(highlight.model).angle == LobeAngle::kReflection;
  records::Profile record =
      profile_record(profile, light, sphere, reflection ? "reflection" : "half_vector");
  if (has_highlight(material)) {
    record.lobe = highlight_record(highlight);
    // Means of R, G and B, at their largest in the lobe.
    double peak = 0, of_diffuse = 0, of_others = 0;
    for (std::size_t i = 0; i < map.angle.size(); ++i) {
      if (!(map.angle[i] < geometry.ends.back())) continue;
      const double alone = radiance_at(formula.analytic, i);
      peak = std::max(peak, alone - formula.diffuse[i]);
      of_diffuse = std::max(of_diffuse, formula.diffuse[i]);
      of_others = std::max(of_others, formula.others(i));
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
