// Makes the pictures of tests/pairs again: write_pairs DIRECTORY. Each pair is one thing that a comparison has to
// let pass, or one mistake that it has to find; its name says which.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <variant>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/core/picture_files.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 32;

Scene scene(const char* name) {
  Scene result =
      read_scene(fmt::format("{}/reference_scenes/scenes/{}.xml", LOBELIA_SOURCE_DIR, name));
  result.film.width = result.film.height = kSide;
  return result;
}

/// A sphere lit at 45 degrees, coloured so that exchanged channels show.
Scene usual(const std::function<void(Highlight&)>& change = {}) {
  Scene result = scene("oblique_45");
  Highlight& highlight = result.materials[0].highlight;
  highlight.model = *find_model("modified_phong");
  highlight.exponent = 32;
  result.materials[0].specular_reflectance = {1, 0.8, 0.5};
  result.materials[0].diffuse_reflectance = {0.3, 0.2, 0.4};
  if (change) change(highlight);
  return result;
}

Image picture(const Scene& of, std::optional<Precision> precision = {}, int samples = 0) {
  Scene sampled = of;
  if (samples > 0) sampled.sampler.sample_count = samples;
  RenderOptions options;
  options.precision = precision;
  return render(sampled, options).image;
}

Image by_engine(const char* name, bool fine = false) {
  const auto engine = make_engine(name, {});
  if (!engine->status().available()) throw Error(ExitCode::kEngine, engine->status().why);
  ReferenceOptions options;
  options.fine = fine;
  ReferenceResult result = Session(*engine, options).render(usual());
  if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);
  return std::move(result.image);
}

/// A picture whose pixel (x, y) is change(x, y, c), c its channel.
Image changed(const Image& image, const std::function<float(int x, int y, int c)>& change) {
  Image result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < 3; ++c) result.pixel(x, y)[std::size_t(c)] = change(x, y, c);
  return result;
}

struct Pairs {
  fs::path directory;
  void write(const std::string& name, const Image& a, const Image& b) const {
    for (const auto& [side, image] : {std::pair{"a", &a}, {"b", &b}}) {
      make_directories(directory / side);
      write_exr(directory / side / (name + ".exr"), *image, {});
    }
  }
};

void write_must_pass(const Pairs& pairs) {
  const Image usual_one = picture(usual());
  pairs.write("same", usual_one, usual_one);
  pairs.write("double_precision_against_float", picture(usual(), Precision::kFloat32),
              picture(usual(), Precision::kFloat64));
  pairs.write("half_floats_of_povray", usual_one, by_engine("povray"));
  pairs.write("floats_of_povray", usual_one, by_engine("povray", true));
  pairs.write("nodes_of_cycles", usual_one, by_engine("blender"));
  pairs.write("fifty_digits", usual_one, by_engine("analytic", true));
  pairs.write("spherical_gaussian_where_it_is_the_cosine_lobe", picture(usual([](Highlight& h) {
                h.lobe = *find_lobe("spherical_gaussian"), h.exponent = 1e4;
              })),
              picture(usual([](Highlight& h) { h.exponent = 1e4; })));
  Scene soft = scene("effects/area_light");
  soft.sampler.seed = 1;
  Scene other = soft;
  other.sampler.seed = 2;
  pairs.write("soft_light_of_another_seed", picture(soft, {}, 32768), picture(other, {}, 32768));
  const Image black(kSide, kSide);
  pairs.write("black", black, black);
}

// ---- files that say more than a picture: layers, windows, colours; 16 x 16 pixels of grey

using namespace fixtures;

constexpr int kFileSide = 16;
using Channels = std::vector<ExrChannel>;

ExrChannel even(const char* name, float value) {
  return {name, std::vector<float>(kFileSide * kFileSide, value)};
}

Channels grey_rgb(Channels more = {}) {
  for (const char* name : {"R", "G", "B"}) more.push_back(even(name, 0.25f));
  return more;
}

/// Has a display window of kFileSide, with this value in a border of `border` pixels around it.
ExrPart with_border(int border, float value) {
  ExrPart part{"",
               window(-border, -border, kFileSide + 2 * border, kFileSide + 2 * border),
               window(0, 0, kFileSide, kFileSide),
               {{"Y", {}}}};
  for (int y = -border; y < kFileSide + border; ++y)
    for (int x = -border; x < kFileSide + border; ++x)
      part.channels[0].values.push_back(x < 0 || y < 0 || x >= kFileSide || y >= kFileSide ? value
                                                                                           : 0.25f);
  return part;
}

struct Files {
  fs::path directory;
  void exr(const std::string& name, const ExrPart& a, const ExrPart& b) const {
    for (const auto& [side, part] : {std::pair{"a", &a}, {"b", &b}}) {
      make_directories(directory / side);
      write_exr_parts(directory / side / (name + ".exr"), {*part});
    }
  }
  void exr(const std::string& name, const Channels& a, const Channels& b) const {
    const auto box = window(0, 0, kFileSide, kFileSide);
    exr(name, ExrPart{"", box, box, a}, ExrPart{"", box, box, b});
  }
  void png(const std::string& name, const Png& a, const Png& b) const {
    for (const auto& [side, picture] : {std::pair{"a", &a}, {"b", &b}}) {
      make_directories(directory / side);
      write_file(directory / side / (name + ".png"), png_file(*picture));
    }
  }
};

Png red_png(const std::string& chunks) {
  Png png{.width = kFileSide, .height = kFileSide};
  for (int i = 0; i < kFileSide * kFileSide; ++i) png.samples += "\xc0\x40\x40";
  png.chunks = chunks;
  return png;
}

void write_files_that_must_pass(const Files& files) {
  files.exr("alpha_of_one_against_none", grey_rgb({even("A", 1)}), grey_rgb());
  files.exr("zeros_outside_of_the_display", with_border(2, 0), with_border(0, 0));
  files.png("a_text_of_a_library",
            red_png(png_chunk("tEXt", std::string("oiio:ColorSpace\0Rec709", 22))), red_png(""));
}

void write_files_that_must_fail(const Files& files) {
  files.exr("transparent_for_opaque", grey_rgb({even("A", 0)}), grey_rgb({even("A", 1)}));
  files.exr("overscan_of_another_value", with_border(2, 2), with_border(2, 1));
  files.exr("overscan_that_one_alone_has", with_border(2, 1), with_border(0, 0));
  const auto box = window(0, 0, kFileSide, kFileSide);
  const Channels red = {even("R", 0.5f), even("G", 0.1f), even("B", 0.1f)};
  ExrPart aces{"", box, box, red};
  aces.chromaticities =
      Imf::Chromaticities({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
  files.exr("values_of_other_primaries", aces, ExrPart{"", box, box, red});
  files.png("values_of_another_curve", red_png(png_chunk("gAMA", big_endian(100000))), red_png(""));
}

void write_must_fail(const Pairs& pairs) {
  const Image good = picture(usual());
  const auto at = [&](int x, int y, int c) {
    return good.pixel(std::clamp(x, 0, kSide - 1), std::clamp(y, 0, kSide - 1))[std::size_t(c)];
  };
  const auto broken = [&](const char* name, const std::function<float(int, int, int)>& change) {
    pairs.write(name, changed(good, change), good);
  };
  const auto one_value = [&](float value) {
    return [=](int x, int y, int c) { return x == 13 && y == 8 && c == 1 ? value : at(x, y, c); };
  };
  broken("one_nan", one_value(std::nanf("")));
  broken("one_infinity", one_value(std::numeric_limits<float>::infinity()));
  broken("one_hot_pixel", one_value(5));
  broken("shifted_by_a_pixel", [&](int x, int y, int c) { return at(x - 1, y, c); });
  broken("mirrored", [&](int x, int y, int c) { return at(kSide - 1 - x, y, c); });
  broken("upside_down", [&](int x, int y, int c) { return at(x, kSide - 1 - y, c); });
  broken("brighter_by_a_thirtieth",
         [&](int x, int y, int c) { return at(x, y, c) * (1 + 1 / 30.f); });
  broken("red_for_blue", [&](int x, int y, int c) { return at(x, y, 2 - c); });
  broken("grey", [&](int x, int y, int) { return (at(x, y, 0) + at(x, y, 1) + at(x, y, 2)) / 3; });
  broken("clipped_at_white", [&](int x, int y, int c) { return std::min(at(x, y, c), 1.0f); });
  broken("encoded_twice", [&](int x, int y, int c) { return std::pow(at(x, y, c), 1 / 2.2f); });
  broken("decoded_twice", [&](int x, int y, int c) { return srgb_decoded(at(x, y, c)); });
  broken("blurred", [&](int x, int y, int c) {
    float sum = 0;
    for (int v = -1; v <= 1; ++v)
      for (int u = -1; u <= 1; ++u) sum += at(x + u, y + v, c);
    return sum / 9;
  });
  broken("every_second_pixel_twice",
         [&](int x, int y, int c) { return at(x / 2 * 2, y / 2 * 2, c); });
  broken("a_black_bar", [&](int x, int y, int c) { return y == 13 ? 0 : at(x, y, c); });
  broken("black", [](int, int, int) { return 0.0f; });

  const auto highlight = [&](const char* name, const std::function<void(Highlight&)>& change) {
    pairs.write(name, picture(usual(change)), good);
  };
  highlight("exponent_34_for_32", [](Highlight& h) { h.exponent = 34; });
  highlight("lobe_of_schlick", [](Highlight& h) { h.lobe = *find_lobe("schlick"); });
  highlight("lobe_cs16_for_cosine", [](Highlight& h) { h.lobe = *find_lobe("cs16"); });
  highlight("without_the_cosine", [](Highlight& h) { h.model = *find_model("phong_rdf"); });
  highlight("distribution_for_reflectance",
            [](Highlight& h) { h.model = *find_model("blinn_phong_ndf"); });
  const auto modified_blinn = [](Normalisation normalisation) {
    return picture(usual([=](Highlight& h) {
      h.model = *find_model("modified_blinn_phong");
      h.normalisation = normalisation;
    }));
  };
  pairs.write("misprinted_coefficient", modified_blinn(Normalisation::kPaper),
              modified_blinn(Normalisation::kExact));

  Scene two = scene("two_lights"), one = two;
  one.lights.pop_back();
  pairs.write("a_light_forgotten", picture(one), picture(two));
  const Scene soft = scene("effects/area_light");
  pairs.write("four_samples", picture(soft, {}, 4), picture(soft, {}, 4096));
}

}  // namespace
}  // namespace lobelia

int main(int count, char** arguments) {
  using namespace lobelia;
  if (count != 2) return fmt::print(stderr, "write_pairs DIRECTORY\n"), 2;
  try {
    const fs::path must_pass = fs::path(arguments[1]) / "must_pass",
                   must_fail = fs::path(arguments[1]) / "must_fail";
    write_files_that_must_pass({must_pass});
    write_files_that_must_fail({must_fail});
    write_must_pass({must_pass});
    write_must_fail({must_fail});
  } catch (const Error& error) {
    return fmt::print(stderr, "write_pairs: {}\n", error.what()), int(error.code());
  }
  return 0;
}
