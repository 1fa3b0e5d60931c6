// Makes the result of each kind of job: its files in a draft, and its part of the record.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "farm/farm_engines.hpp"
#include "farm/job.hpp"
#include "farm/result_cache.hpp"
#include "reference_scenes/failure.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

struct Tolerance;

/// Something is wrong with one result, and with nothing else.
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
std::string comparison_name(const std::string& engine);

/// lobelia.exr, .json and .png, scene.xml, and lobelia-error.exr where the picture is an average. Throws
/// ResultFailure if it takes longer than `time_limit`, needs more bytes than `memory_limit` (0: any number) or is not
/// finite.
void make_render(const Scene& scene, ResultDraft& draft, std::chrono::duration<double> time_limit,
                 std::uint64_t memory_limit, records::Result& record);

/// An engine's picture: ENGINE.exr, .json, .log and ENGINE-error.exr. `result` has no error.
void make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, ResultDraft& draft, records::Result& record);

/// ENGINE.png at our picture's exposure, and unless its noise is not known, lobelia-ENGINE.json and .png.
void make_comparison(const Scene& scene, const MadePicture& ours, const MadePicture& theirs,
                     ResultDraft& draft, records::Result& record);

/// The engine's (reference_scenes/engine.hpp). Up to three pixels may be farther off, all of them in `edges`
/// (truth::edge_ring): a silhouette or a terminator may fall on the other side of a pixel's centre.
Tolerance tolerance_of(std::string_view engine, std::vector<std::uint8_t> edges);

/// profile.json.
void make_profile(const Scene& scene, const std::vector<MadePicture>& pictures, ResultDraft& draft);

/// Reads a picture of a result again: ResultFailure unless it opens, has the scene's size and finite values.
Image read_whole_picture(const std::filesystem::path& file, const Scene& scene);

/// The exposure at which a cell is looked at: the brightest value of our picture becomes white.
double cell_exposure(const Image& ours);

}  // namespace lobelia
