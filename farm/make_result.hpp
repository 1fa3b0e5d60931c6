// Makes the result of each kind of job: its files in a draft, and its part of the record.
#pragma once

#include <chrono>

#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "farm/farm_engines.hpp"
#include "farm/result_cache.hpp"
#include "reference_scenes/failure.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// One result is wrong; the run goes on.
class ResultFailure : public Error {
 public:
  ResultFailure(FailureClass kind, const std::string& message)
      : Error(ExitCode::kEngine, message), kind_(kind) {}
  FailureClass kind() const { return kind_; }

 private:
  FailureClass kind_;
};

/// An engine's result in the cache.
struct MadePicture {
  std::string engine;
  std::filesystem::path directory;
};

/// ENGINE.exr, ENGINE-error.exr and so on; docs/records.md.
std::string picture_file(const std::string& engine);
std::string error_file(const std::string& engine);
std::string comparison_name(const std::string& a, const std::string& b);

/// Writes lobelia.exr, .json and .png, scene.xml, and lobelia-error.exr if the picture is an average. Throws ResultFailure
/// over `time_limit`, over `memory_limit` (bytes; 0: no limit), or if a value is not finite.
void make_render(const Scene& scene, ResultDraft& draft, std::chrono::duration<double> time_limit,
                 std::uint64_t memory_limit, records::Result& record);

/// Writes ENGINE.exr, .json, .log and ENGINE-error.exr. `result` must be a success.
void make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, ResultDraft& draft, records::Result& record);

/// Two pictures of a cell, read again.
struct PicturesOfCell {
  Image a, b;
  double exposure_stops = 0;               ///< at which our picture's brightest value is white
  std::optional<NoiseOptions> noise = {};  ///< of averages, if both have their errors
};
PicturesOfCell read_pictures(const Scene& scene, const MadePicture& a, const MadePicture& b,
                             const MadePicture& ours);

/// A comparison of two engines' pictures.
struct ComparisonTask {
  std::string a, b;
  bool shows_a = false;  ///< which of them gets a PNG
};

/// Writes the shown engine's .png and, unless the noise is unknown, A-B.json and .png. The floors of both engines add up.
/// Up to three pixels on silhouettes, terminators and shadow edges may exceed the tolerance, because an edge may fall on
/// the other side of a pixel's centre.
void make_comparison(const Scene& scene, const ComparisonTask& task, PicturesOfCell pictures,
                     const std::vector<EngineFloor>& floors, ResultDraft& draft,
                     records::Result& record);

/// `scene` is one that truth::evaluate() takes; edges are only of such scenes.
Tolerance tolerance_of(const Scene& scene, const std::vector<EngineFloor>& floors);

/// How a cell is judged: without noise by the tolerance alone, with noise also by the default limits, as given ones.
Comparison judge_cell(const Image& a, const Image& b, double exposure_stops, Tolerance tolerance,
                      std::optional<NoiseOptions> noise);

/// Writes profile.json.
void make_profile(const Scene& scene, const std::vector<MadePicture>& pictures, ResultDraft& draft);

}  // namespace lobelia
