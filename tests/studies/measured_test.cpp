// Readers and fits of measured materials, on files that are made here from closed forms.
#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "lobelia_paths.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/measured/fit.hpp"
#include "tests/studies/merl_file.hpp"
#include "tests/test.hpp"

namespace lobelia::measured {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Rgb random_colour(Random& random, double most) {
  return {uniform(random, 0.05, most), uniform(random, 0.05, most), uniform(random, 0.05, most)};
}

std::string merl_bytes(const std::function<Rgb(const Directions&)>& brdf) {
  return lobelia::merl_bytes([&](Vec3 to_eye, Vec3 to_light) { return brdf({to_eye, to_light}); });
}

double half_cosine(const Directions& to) { return normalize(to.to_eye + to.to_light).z; }

/// (n + 2) / (8 pi) cos^n, the distribution of normals of the heightfield over 4.
double blinn_phong(const Directions& to, double n) {
  return (n + 2) / (8 * kPi) * std::pow(half_cosine(to), n);
}

double ggx_d(double alpha, double cosine) {
  const double a2 = alpha * alpha, b = cosine * cosine * (a2 - 1) + 1;
  return a2 / (kPi * b * b);
}

double lambda(double alpha, double c) {
  return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2;
}

double ggx(const Directions& to, double alpha) {
  const double l = to.to_light.z, v = to.to_eye.z;
  return ggx_d(alpha, half_cosine(to)) / (4 * l * v * (1 + lambda(alpha, l) + lambda(alpha, v)));
}

void expect_near(const records::Triple& found, Rgb expected, double tolerance) {
  EXPECT_NEAR(found[0], expected.r, tolerance);
  EXPECT_NEAR(found[1], expected.g, tolerance);
  EXPECT_NEAR(found[2], expected.b, tolerance);
}

Highlight kind(std::string_view model, std::string_view lobe) {
  return {*find_model(model), *find_lobe(lobe)};
}

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_EQ(error.lines().size(), 1u);
    return error.what();
  }
  return "nothing was refused";
}

TEST(Merl, FindsEachCellFromTheDirectionsInItsMiddle) {
  const auto code = [](const Directions& to) {
    const HalfDifference at = half_difference(to);
    return Rgb{at.theta_h + 1, at.theta_d + 1, at.phi_d < 0 ? at.phi_d + kPi : at.phi_d};
  };
  const MeasuredBrdf brdf = parse_merl(merl_bytes(code), "made");
  Random random(7);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const double ring = std::floor(uniform(random, 0, 90)) + 0.5;
    const auto degrees = [&](int n) {
      return (std::floor(uniform(random, 0, n)) + 0.5) * kPi / 180;
    };
    const HalfDifference at{merl_theta_h(ring), degrees(90), degrees(180)};
    const Directions to = directions(at);
    if (to.to_eye.z <= 0 || to.to_light.z <= 0) continue;
    // A turn about the normal changes nothing.
    const double turn = uniform(random, 0, 2 * kPi), c = std::cos(turn), s = std::sin(turn);
    const auto turned = [&](Vec3 v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
    const auto value = brdf.radiance(turned(to.to_eye), turned(to.to_light));
    ASSERT_TRUE(value.has_value());
    EXPECT_NEAR(value->r / to.to_light.z, at.theta_h + 1, 1e-6);
    EXPECT_NEAR(value->g / to.to_light.z, at.theta_d + 1, 1e-6);
    EXPECT_NEAR(value->b / to.to_light.z, at.phi_d, 1e-6);
    // The same BRDF if light and eye change places.
    const auto swapped = brdf.radiance(to.to_light, to.to_eye);
    ASSERT_TRUE(swapped.has_value());
    EXPECT_NEAR(swapped->b / to.to_eye.z, at.phi_d, 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 5000);
}

TEST(Fit, FindsTheExponentOfASampledBlinnPhong) {
  Random random(1);
  for (const double n : {3.0, 47.0, 700.0, 2e4, 1.2e5}) {
    const Rgb diffuse = random_colour(random, 0.6), specular = random_colour(random, 0.5);
    const auto brdf = parse_merl(merl_bytes([&](const Directions& to) {
                                   return 1 / kPi * diffuse + blinn_phong(to, n) * specular;
                                 }),
                                 "made");
    const Highlight kinds[] = {kind("blinn_phong_heightfield", "cosine"),
                               kind("phong_rdf", "cs16")};
    const records::MeasuredFits fits = fit(brdf, kinds);
    const records::MeasuredFit& best = fits.fits.front();
    SCOPED_TRACE(n);
    EXPECT_EQ(best.model, "blinn_phong_heightfield");
    // 9e-8 measured for the exponent, 2e-8 for the others: the table's values are kept as float32.
    EXPECT_NEAR(best.exponent / n, 1, 1e-6);
    expect_near(best.diffuse, diffuse, 1e-6);
    expect_near(best.specular, specular, 1e-6);
    EXPECT_LT(best.rms_of_measured, 1e-6);
    EXPECT_GT(fits.fits.back().rms_of_measured, 0.05);
    EXPECT_FALSE(best.is_end_of_range);
  }
}

TEST(Fit, FindsTheAlphaOfASampledGgx) {
  for (const double alpha : {0.02, 0.15, 0.5}) {
    const auto brdf = parse_merl(merl_bytes([&](const Directions& to) {
                                   const double f = 0.7 * ggx(to, alpha) + 0.1 / kPi;
                                   return Rgb{f, f, f};
                                 }),
                                 "made");
    const Highlight kinds[] = {kind("microfacet_smith", "ggx"), kind("modified_phong", "cosine")};
    const records::MeasuredFit best = fit(brdf, kinds).fits.front();
    EXPECT_NEAR(best.alpha.value_or(0) / alpha, 1, 1e-6);  // 2e-8 measured
    expect_near(best.specular, {0.7, 0.7, 0.7}, 1e-6);
    expect_near(best.diffuse, {0.1, 0.1, 0.1}, 1e-6);
  }
}

TEST(MeasuredPicture, EqualsTheClosedFormOfALambertian) {
  const Rgb albedo{0.2, 0.5, 0.8};
  const auto brdf =
      parse_merl(merl_bytes([&](const Directions&) { return 1 / kPi * albedo; }), "a");
  records::MeasuredFit fit;
  fit.model = "phong_rdf";
  fit.lobe = "cosine";
  fit.exponent = 10;
  fit.diffuse = {albedo.r, albedo.g, albedo.b};
  for (const NamedScene& one : canonical_scenes()) {
    const Image picture = measured_picture(one.scene, brdf);
    const Vec3 to_light = -std::get<DirectionalLight>(one.scene.lights.front()).direction;
    // The middle of the film shows the point of the sphere that faces the camera, but for half a pixel.
    const auto middle = picture.pixel(one.scene.film.width / 2, one.scene.film.height / 2);
    EXPECT_NEAR(middle[1], albedo.g / kPi * to_light.z, 2e-3) << one.name;
    EXPECT_NEAR(middle[2] / middle[0], albedo.b / albedo.r, 1e-5) << one.name;
    EXPECT_EQ(picture.pixel(0, 0)[0], 0) << one.name;
    EXPECT_EQ(with_fit(one.scene, fit).materials.front().diffuse_reflectance, albedo);
  }
}

TEST(CanonicalScenes, EqualTheirFiles) {
  records::MeasuredFit fit;
  fit.model = "phong_rdf";
  fit.lobe = "cosine";
  fit.exponent = 10;
  for (const NamedScene& one : canonical_scenes()) {
    const Scene read =
        read_scene(LOBELIA_SOURCE_DIR "/reference_scenes/scenes/" + one.name + ".xml");
    EXPECT_EQ(scene_to_xml(with_fit(one.scene, fit)), scene_to_xml(with_fit(read, fit)));
  }
}

TEST(Merl, RefusesHostileFilesInOneLine) {
  const auto refused = [](const std::string& bytes) {
    return refusal([&] { parse_merl(bytes, "f"); });
  };
  EXPECT_THAT(refused(""), HasSubstr("is no MERL file"));
  std::string huge(12, '\x7f');
  EXPECT_THAT(refused(huge), HasSubstr("2139062143"));
  std::string bytes = merl_bytes([](const Directions&) { return Rgb{}; });
  EXPECT_THAT(refused(bytes.substr(0, 1000)), HasSubstr("has 1000 bytes"));
  EXPECT_THAT(refused(bytes + "x"), HasSubstr("bytes"));
  EXPECT_THAT(refusal([&] { fit(parse_merl(bytes, "f"), all_kinds()); }), HasSubstr("is 0"));
  for (const double value : {kNaN, kInfinity, -kInfinity, 1e13}) {
    std::memcpy(bytes.data() + 12, &value, sizeof value);
    EXPECT_THAT(refused(bytes), HasSubstr("value 0 of channel 0"));
  }
}

// ---- RGL

struct Tensor {
  std::string name;
  std::uint8_t type;
  std::vector<std::uint64_t> shape;
  std::string data;
};

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

Tensor floats(std::string name, std::vector<std::uint64_t> shape,
              const std::vector<float>& values) {
  return {std::move(name), 10, std::move(shape),
          std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size())};
}

/// As the format's authors lay it out: a header of all fields, then their data.
std::string tensor_file(const std::vector<Tensor>& tensors) {
  std::string bytes("tensor_file\0\1\0", 14);
  append(bytes, std::uint32_t(tensors.size()));
  std::size_t at = bytes.size();
  for (const Tensor& one : tensors) at += 2 + one.name.size() + 2 + 1 + 8 + 8 * one.shape.size();
  for (const Tensor& one : tensors) {
    append(bytes, std::uint16_t(one.name.size()));
    bytes += one.name;
    append(bytes, std::uint16_t(one.shape.size()));
    append(bytes, one.type);
    append(bytes, std::uint64_t(at));
    for (const std::uint64_t side : one.shape) append(bytes, side);
    at += one.data.size();
  }
  for (const Tensor& one : tensors) bytes += one.data;
  return bytes;
}

/// A material with ndf = 4 sigma, and red and green that are the place in the warped square: it shows the warp.
std::vector<Tensor> warp_tensors(const std::vector<float>& vndf, std::uint64_t side) {
  return {floats("theta_i", {2}, {0, 1}),
          floats("phi_i", {1}, {0}),
          floats("ndf", {2, 2}, {2, 2, 2, 2}),
          floats("sigma", {2, 2}, {.5, .5, .5, .5}),
          floats("vndf", {1, 2, side, side}, vndf),
          floats("rgb", {1, 2, 3, 2, 2}, {0, 1, 0, 1, 0, 0, 1, 1, .5, .5, .5, .5,  //
                                          0, 1, 0, 1, 0, 0, 1, 1, .5, .5, .5, .5}),
          Tensor{"jacobian", 1, {1}, "\1"}};
}

/// Eye and light with the half vector at a place of the square; none if the light is below the horizon.
std::optional<Directions> directions_at(double theta_i, double phi_i, double u, double v) {
  const auto polar = [](double theta, double phi) {
    return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  const Vec3 i = polar(theta_i, phi_i), m = polar(u * u * kRightAngle, phi_i + (2 * v - 1) * kPi);
  const Vec3 o = 2 * dot(i, m) * m - i;
  if (o.z <= 0.01 || dot(i, m) <= 0.01) return std::nullopt;
  return Directions{i, o};
}

/// Integrals of a bilinear density by the midpoint rule: the share of the row left of u, and of all rows below v.
std::pair<double, double> shares(const std::function<double(double, double)>& density, double u,
                                 double v) {
  constexpr int kSteps = 400;
  const auto integral = [](const std::function<double(double)>& f, double end) {
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += f(end * (i + 0.5) / kSteps) * end / kSteps;
    return sum;
  };
  const auto row = [&](double y, double end) {
    return integral([&](double x) { return density(x, y); }, end);
  };
  const auto rows = [&](double end) { return integral([&](double y) { return row(y, 1); }, end); };
  return {row(v, u) / row(v, 1), rows(v) / rows(1)};
}

TEST(Rgl, WarpsByTheIntegralsOfTheDensity) {
  constexpr std::size_t kSide = 4;
  Random random(3);
  std::vector<float> vndf(2 * kSide * kSide);
  for (float& value : vndf) value = float(uniform(random, 0.1, 2));
  const MeasuredBrdf brdf = parse_rgl(tensor_file(warp_tensors(vndf, kSide)), "made");
  const auto slice = [&](std::size_t s, double x, double y) {
    x *= kSide - 1;
    y *= kSide - 1;
    const std::size_t c = std::min(std::size_t(x), kSide - 2),
                      r = std::min(std::size_t(y), kSide - 2);
    const float* const at = vndf.data() + s * kSide * kSide + r * kSide + c;
    return std::lerp(std::lerp(at[0], at[1], x - double(c)),
                     std::lerp(at[kSide], at[kSide + 1], x - double(c)), y - double(r));
  };
  // Each slice counts as a density of integral 1; bilinear tables are summed exactly by the trapezoid rule.
  double totals[2] = {};
  for (std::size_t s = 0; s < 2; ++s)
    for (const double i : {0, 1, 2})
      for (const double j : {0, 1, 2}) totals[s] += slice(s, (i + 0.5) / 3, (j + 0.5) / 3) / 9;
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const double theta = uniform(random, 0.05, 1), u = uniform(random, 0, 0.8),
                 v = uniform(random, 0, 1);
    const auto to = directions_at(theta, uniform(random, -3, 3), u, v);
    if (!to) continue;
    const auto found = brdf.radiance(to->to_eye, to->to_light);
    ASSERT_TRUE(found.has_value());
    const auto [x, y] = shares(
        [&](double a, double b) {
          return std::lerp(slice(0, a, b) / totals[0], slice(1, a, b) / totals[1], theta);
        },
        u, v);
    EXPECT_NEAR(found->r, x, 2e-5);  // 2e-6 measured
    EXPECT_NEAR(found->g, y, 2e-5);
    EXPECT_NEAR(found->b, 0.5, 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(Rgl, EqualsTheMicrofacetModelOfItsDistribution) {
  constexpr std::size_t kSteps = 600;
  constexpr double kAlpha = 0.4;
  auto tensors = warp_tensors(std::vector<float>(8, 1), 2);
  std::vector<float> ndf, sigma;
  for (int row = 0; row < 2; ++row)
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double u = double(i) / kSteps, c = std::max(std::cos(u * u * kRightAngle), 1e-6);
      ndf.push_back(float(ggx_d(kAlpha, c)));
      sigma.push_back(float(c * (1 + lambda(kAlpha, c))));
    }
  tensors[2] = floats("ndf", {2, kSteps + 1}, ndf);
  tensors[3] = floats("sigma", {2, kSteps + 1}, sigma);
  const MeasuredBrdf brdf = parse_rgl(tensor_file(tensors), "made");
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double theta = uniform(random, 0, 1.4), u = uniform(random, 0, 0.8);
    const auto to = directions_at(theta, uniform(random, -3, 3), u, uniform(random, 0, 1));
    if (!to) continue;
    const double c = std::cos(theta);
    const double expected =
        ggx_d(kAlpha, std::cos(u * u * kRightAngle)) / (4 * c * (1 + lambda(kAlpha, c)));
    EXPECT_NEAR(2 * brdf.radiance(to->to_eye, to->to_light)->b / expected, 1,
                1e-4);  // 2e-5 measured
  }
}

TEST(Rgl, RefusesHostileFilesInOneLine) {
  const std::vector<float> even(8, 1);
  const auto good = warp_tensors(even, 2);
  const auto refused = [](const std::string& bytes) {
    return refusal([&] { parse_rgl(bytes, "f"); });
  };
  const std::string bytes = tensor_file(good);
  EXPECT_THAT(refused("tensor_file"), HasSubstr("is no tensor file"));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(refused(bytes.substr(0, size)), StartsWith("f: ")) << size;
  const auto with = [&](std::size_t place, const Tensor& other) {
    auto tensors = good;
    tensors[place] = other;
    return refused(tensor_file(tensors));
  };
  constexpr std::uint64_t kHuge = std::uint64_t{1} << 62;
  EXPECT_THAT(with(2, floats("ndf", {kHuge, kHuge}, {1, 1, 1, 1})), HasSubstr("'ndf' has a side"));
  EXPECT_THAT(with(2, floats("ndf", {200, 200}, {1, 1, 1, 1})), HasSubstr("beyond the end"));
  EXPECT_THAT(with(2, floats("ndf", {0, 2}, {})), HasSubstr("side of 0"));
  EXPECT_THAT(with(2, floats("ndf", {4}, {1, 1, 1, 1})), HasSubstr("dimensions"));
  EXPECT_THAT(with(2, floats("ndf", {2, 2}, {1, 1, 1, float(kNaN)})), HasSubstr("'ndf' is nan"));
  EXPECT_THAT(with(4, floats("vndf", {1, 2, 2, 2}, std::vector<float>(8))), HasSubstr("is 0"));
  EXPECT_THAT(with(4, floats("vndf", {2, 1, 2, 2}, even)), HasSubstr("other sides"));
  EXPECT_THAT(with(0, floats("theta_i", {2}, {1, 1})), HasSubstr("do not ascend"));
  EXPECT_THAT(with(1, floats("phi_i", {8}, even)), HasSubstr("anisotropic"));
  EXPECT_THAT(with(5, floats("spectra", {1}, {1})), HasSubstr("spectral"));
  EXPECT_THAT(with(5, floats("sigma", {1}, {1})), HasSubstr("there twice"));
  EXPECT_THAT(with(6, {"jacobian", 1, {1}, std::string(1, '\0')}), HasSubstr("'jacobian' is 0"));
  EXPECT_THAT(with(6, {"jacobian", 77, {1}, "\1"}), HasSubstr("unknown type"));
  std::string overlapping = bytes;  // theta_i and phi_i begin at one byte
  const std::size_t first = 18 + 2 + 7 + 3, second = first + 16 + 2 + 5 + 3;
  std::memcpy(overlapping.data() + second, bytes.data() + first, 8);
  EXPECT_THAT(refused(overlapping), HasSubstr("overlap"));
}

}  // namespace
}  // namespace lobelia::measured
