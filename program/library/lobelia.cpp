// The public library: each function calls the rooms, and turns their types and errors into its own.
#define LOBELIA_NAMESPACE namespace
#include "lobelia/lobelia.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/threads.hpp"
#include "base/system/version.hpp"
#include "base/words/choice.hpp"
#include "base/words/text.hpp"
#include "compare/set/run.hpp"
#include "profile/blob.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"

// Inside this file lobelia::X is the room's, v0::X the public one: elsewhere v0 is an inline namespace.
namespace lobelia::v0 {
namespace {

ErrorCode code_of(ExitCode code) {
  switch (code) {
    case ExitCode::kUsage:
      return ErrorCode::usage;
    case ExitCode::kInput:
      return ErrorCode::input;
    case ExitCode::kOutput:
      return ErrorCode::output;
    case ExitCode::kEngine:
      return ErrorCode::engine;
    case ExitCode::kNoResources:
      return ErrorCode::resources;
    default:
      return ErrorCode::internal;
  }
}

/// Carries an exception of the caller's own function through guarded().
struct OfCaller {
  std::exception_ptr what;
};

template <class Work>
auto guarded(Work&& work) {
  try {
    keep_to_usual_threads();
    return work();
  } catch (const OfCaller& thrown) {
    std::rethrow_exception(thrown.what);
  } catch (const lobelia::Error& error) {
    throw v0::Error(code_of(error.code()), error.what());
  } catch (const v0::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const lobelia::Error known = as_error(error);
    throw v0::Error(code_of(known.code()), known.what());
  }
}

[[noreturn]] void refuse(const std::string& message) { throw v0::Error(ErrorCode::usage, message); }

template <class Number>
void require(std::string_view what, Number value, double min, double max) {
  // A NaN is refused too.
  if (!(double(value) >= min && double(value) <= max))
    refuse(fmt::format("{} {} is out of range; allowed: {:g} to {:g}", what, value, min, max));
}

ModelId model_of(const std::string& name) {
  return chosen(name, "model", model_names(), find_model);
}
LobeId lobe_of(const std::string& name) {
  return chosen(name, "lobe", lobe_names(), allowed_lobes(), find_lobe);
}
Normalisation normalisation_of(const std::string& name) {
  return chosen(name, "normalisation", normalisation_names(), find_normalisation);
}

Image image_of(const Picture& picture) {
  require("a picture's width", picture.width, 1, kMaxImageSide);
  require("a picture's height", picture.height, 1, kMaxImageSide);
  const std::int64_t pixels = std::int64_t{picture.width} * picture.height;
  require("a picture's number of pixels", pixels, 1, double(kMaxImagePixels));
  if (picture.rgb.size() != std::size_t(3 * pixels))
    refuse(fmt::format("a picture of {} x {} pixels has {} values, not {}", picture.width,
                       picture.height, 3 * pixels, picture.rgb.size()));
  Image image(picture.width, picture.height);
  std::ranges::copy(picture.rgb, image.values().begin());
  return image;
}

Picture picture_of(const Image& image) {
  return {image.width(), image.height(), {image.values().begin(), image.values().end()}};
}

void apply(const RenderSettings& settings, Scene& scene) {
  for (Material& material : scene.materials) {
    lobelia::Highlight& highlight = material.highlight;
    if (!settings.model.empty()) highlight.model = model_of(settings.model);
    if (!settings.lobe.empty()) highlight.lobe = lobe_of(settings.lobe);
    if (!settings.normalisation.empty())
      highlight.normalisation = normalisation_of(settings.normalisation);
    if (settings.exponent) {
      require("exponent", *settings.exponent, kMinExponent, kMaxExponent);
      highlight.exponent = *settings.exponent;
    }
    // The paper may have no coefficient for the lobe.
    radiance_coefficient(highlight);
  }
  const auto replace = [](const auto& given, std::string_view what, double max, auto& value) {
    if (!given) return;
    require(what, *given, what == "seed" ? 0 : 1, max);
    value = *given;
  };
  replace(settings.width, "width", kMaxImageSide, scene.film.width);
  replace(settings.height, "height", kMaxImageSide, scene.film.height);
  require("number of pixels", std::int64_t{scene.film.width} * scene.film.height, 1,
          double(kMaxImagePixels));
  replace(settings.samples, "samples", 65536, scene.sampler.sample_count);
  if (settings.seed) scene.sampler.seed = *settings.seed;
}

Rendered rendered(Scene scene, const RenderSettings& settings) {
  require("threads", settings.threads, 0, 1024);
  apply(settings, scene);
  scene.sampler.averages_small_highlights = true;
  RenderOptions options;
  options.threads = settings.threads;
  if (settings.on_progress)
    options.on_progress = [&](double fraction) {
      try {
        settings.on_progress(fraction);
      } catch (...) {
        throw OfCaller{std::current_exception()};
      }
    };
  const RenderResult result = lobelia::render(scene, options);
  return {picture_of(result.image), result.samples, result.render_seconds, result.instruction_set};
}

CompareChoice choice_of(const CompareSettings& settings, const CompareOptions& options,
                        CompareOption::For pictures) {
  std::vector<GivenOption> given;
  for (const auto& [name, value] : options) {
    const auto found = std::ranges::find(given, name, &GivenOption::name);
    if (found == given.end())
      given.push_back({name, std::vector{value}});
    else
      found->texts->push_back(value);
  }
  CompareChoice choice = read_choice(given, pictures);
  for (const Limit& limit : settings.limits)
    choice.fail.push_back(fmt::format("{}={}", limit.metric, limit.limit));
  if (!settings.default_limits) choice.no_default_limits = true;
  for (const std::string& metric : settings.metrics)
    choice.metrics += (choice.metrics.empty() ? "" : ",") + metric;
  return choice;
}

/// Compares the pictures in memory, or without them the two files.
Comparison compared(const CompareChoice& choice, const std::string& picture,
                    const std::string& reference, PicturePair* in_memory) {
  const CompareJob job = make_job(choice, nullptr);
  PairReport report;
  report.a = picture;
  report.b = reference;
  ThreadLimit(choice.threads).run([&] {
    if (in_memory) {
      report = compare_in_memory(job, std::move(report), *in_memory);
      return;
    }
    PicturePair files = read_two(job, report);
    report = compare_two(job, std::move(report), files);
  });
  const lobelia::Comparison& found = *report.comparison;
  Comparison result;
  result.pass = is_pass(report.verdict());
  result.verdict = verdict_name(report.verdict());
  result.metrics = found.metrics;
  for (const LimitResult& limit : found.limits)
    result.limits.push_back({limit.metric, limit.limit, limit.value, limit.pass});
  result.record = records::record_text(pair_record(report));
  return result;
}

}  // namespace

Error::Error(ErrorCode code, const std::string& message)
    : std::runtime_error(message), code_(code) {}
Error::~Error() = default;

std::string version() { return LOBELIA_VERSION; }

Picture read_picture(const std::string& file) {
  return guarded([&] { return picture_of(read_image(file)); });
}

void write_exr(const std::string& file, const Picture& picture) {
  guarded([&] { lobelia::write_exr(file, image_of(picture), ImageMetadata{}); });
}

Rendered render(const std::string& scene_file, const RenderSettings& settings) {
  return guarded([&] { return rendered(read_scene(scene_file), settings); });
}

Rendered render_text(const std::string& scene_xml, const RenderSettings& settings) {
  return guarded([&] { return rendered(parse_scene(scene_xml, "scene"), settings); });
}

double Comparison::value(const std::string& metric) const {
  for (const auto& [id, value] : metrics)
    if (id == metric) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

Comparison compare(const Picture& picture, const Picture& reference,
                   const CompareSettings& settings) {
  return compare(picture, reference, settings, {});
}

Comparison compare(const Picture& picture, const Picture& reference,
                   const CompareSettings& settings, const CompareOptions& options) {
  return guarded([&] {
    const CompareChoice choice = choice_of(settings, options, CompareOption::For::kPictures);
    PicturePair pair{{image_of(picture), {}, {}}, {image_of(reference), {}, {}}};
    return compared(choice, "picture", "reference", &pair);
  });
}

Comparison compare_files(const std::string& picture, const std::string& reference,
                         const CompareSettings& settings, const CompareOptions& options) {
  return guarded([&] {
    const CompareChoice choice = choice_of(settings, options, CompareOption::For::kFiles);
    return compared(choice, picture, reference, nullptr);
  });
}

Profile profile(const Picture& picture, double least_share) {
  return guarded([&] {
    require("least share", least_share, 0, 1);
    const Image image = image_of(picture);
    BlobOptions options;
    options.search.least_share = least_share;
    const BlobProfiles found = measure_blobs({{"picture", &image}}, options);
    Profile result;
    for (const BlobProfile& one : found.highlights) {
      const BlobFigures& figures = one.blobs.front();
      if (!figures.why_not.empty()) continue;
      result.highlights.push_back({figures.peak.place.x, figures.peak.place.y, figures.peak.value,
                                   figures.background, figures.major_half_width,
                                   figures.minor_half_width, figures.energy, figures.remark});
    }
    result.record = records::record_text(blobs_record(found, least_share));
    return result;
  });
}

std::vector<Lobe> lobes() {
  return guarded([] {
    std::vector<Lobe> result;
    for (const LobeId& id : all_lobes()) {
      const LobeInfo& one = info(id);
      result.push_back({std::string(one.name), std::string(one.title), std::string(one.formula)});
    }
    return result;
  });
}

std::vector<Model> models() {
  return guarded([] {
    std::vector<Model> result;
    for (const ModelInfo& one : lobelia::models())
      result.push_back({std::string(one.name), std::string(one.title),
                        one.angle == LobeAngle::kHalfVector, one.applies_cosine,
                        one.has_shadowing});
    return result;
  });
}

std::vector<std::string> normalisations() {
  return guarded([] {
    return std::vector<std::string>(normalisation_names().begin(), normalisation_names().end());
  });
}

double lobe_value(const std::string& lobe, double s, double exponent) {
  return lobe_values(lobe, {s}, exponent).front();
}

std::vector<double> lobe_values(const std::string& lobe, const std::vector<double>& s,
                                double exponent) {
  return guarded([&] {
    require("exponent", exponent, kMinExponent, kMaxExponent);
    const LobeId id = lobe_of(lobe);
    const PreparedLobe prepared = prepare(id, exponent);
    std::vector<double> values;
    values.reserve(s.size());
    for (const double one : s) {
      require("s", one, 0, 2);
      values.push_back(prepared.value(one));
    }
    return values;
  });
}

double coefficient(const std::string& model, const std::string& lobe, double exponent,
                   const std::string& normalisation) {
  return guarded([&] {
    require("exponent", exponent, kMinExponent, kMaxExponent);
    return radiance_coefficient(
        {model_of(model), lobe_of(lobe), normalisation_of(normalisation), exponent});
  });
}

}  // namespace lobelia::v0
