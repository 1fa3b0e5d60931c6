// Lobelia as a library: render a scene, compare two pictures, profile a highlight; and its models and lobes as functions.
// docs/library.md shows how to build with it. This header needs C++17 and nothing but the standard library.
//
// Every function may be called from several threads at once, and throws lobelia::Error or std::bad_alloc, nothing else.
// None prints, reads the environment's options of the program, or installs a signal handler.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lobelia/version.hpp"

#if defined(__GNUC__)
#define LOBELIA_API __attribute__((visibility("default")))
#else
#define LOBELIA_API
#endif
#ifndef LOBELIA_NAMESPACE
#define LOBELIA_NAMESPACE inline namespace
#endif

namespace lobelia {
/// The ABI: changes with the SONAME.
LOBELIA_NAMESPACE v0 {
  /// Exit codes of the program that stand for a failure.
  enum class ErrorCode : int {
    usage = 2,       ///< an argument is out of range, or names nothing that is known
    input = 3,       ///< a file cannot be read, is invalid, or two pictures do not match
    output = 4,      ///< a file cannot be written
    engine = 5,      ///< a reference engine is missing or failed
    internal = 70,   ///< a bug of Lobelia
    resources = 71,  ///< the system gives no more memory, threads, processes or open files
  };

  /// The only exception of this library. what() is complete: what is wrong, where, and what is allowed.
  class LOBELIA_API Error : public std::runtime_error {
   public:
    Error(ErrorCode code, const std::string& message);
    ~Error() override;
    ErrorCode code() const noexcept { return code_; }

   private:
    ErrorCode code_;
  };

  /// "0.1.0": of the library that runs, where LOBELIA_VERSION is that of this header.
  LOBELIA_API std::string version();

  // ---- pictures

  /// Linear light: radiance, Rec. 709 primaries, any finite or non-finite float.
  struct Picture {
    int width = 0, height = 0;  ///< pixels, 1 to 32768 each, at most 2^27 together
    /// 3 * width * height values: row by row from the top, left to right, R, G and B of each pixel.
    std::vector<float> rgb;
  };

  /// Reads OpenEXR, PNG, JPEG or TIFF, told by its first bytes. A file's integers are decoded from sRGB unless it says
  /// otherwise. Decoding runs in a process of its own. Throws Error(input).
  LOBELIA_API Picture read_picture(const std::string& file);

  /// Writes float32 OpenEXR in one step, replacing `file`. Throws Error(output), and Error(usage) for a wrong shape.
  LOBELIA_API void write_exr(const std::string& file, const Picture& picture);

  // ---- render

  /// Changes to a scene, and how to render it. An empty or missing value leaves the scene as it is.
  struct RenderSettings {
    std::string model, lobe, normalisation;  ///< names as in models(), lobes() and normalisations()
    std::optional<double> exponent;          ///< n, 0 to 1e8
    std::optional<int> width, height;        ///< pixels, 1 to 32768
    std::optional<int> samples;              ///< rays a pixel, 1 to 65536; 1 is the pixel's centre
    std::optional<std::uint64_t> seed;       ///< of the positions of more than one sample
    int threads = 0;                         ///< 0 to 1024; 0: all processors
    /// Called with the fraction done, 0 to 1, from any thread and not in order. May throw: that ends the render, and
    /// render() throws it on.
    std::function<void(double)> on_progress;
  };

  struct Rendered {
    Picture picture;
    int samples = 0;              ///< rays taken of each pixel
    double seconds = 0;           ///< of rendering
    std::string instruction_set;  ///< "AVX2": chosen for this processor
  };

  /// Renders a scene file (docs/scene_format.md). The same scene gives the same picture, bit for bit, with any number of
  /// threads. Throws Error(input) with one line for each error of the file, Error(usage) for a setting out of range.
  LOBELIA_API Rendered render(const std::string& scene_file, const RenderSettings& settings = {});

  /// The same for the text of a scene. It may not name picture files.
  LOBELIA_API Rendered render_text(const std::string& scene_xml,
                                   const RenderSettings& settings = {});

  // ---- compare

  /// A metric, and the last value that passes. docs/metrics.md lists metrics and their units.
  struct Limit {
    std::string metric;
    double limit = 0;
  };

  struct CompareSettings {
    std::vector<Limit>
        limits;  ///< besides the default ones; each replaces the default on its metric
    bool default_limits = true;  ///< docs/limits.md
    /// Metrics to measure, by id, family or region; empty: all that need no option.
    std::vector<std::string> metrics;
  };

  struct Judged {
    std::string metric;
    double limit = 0;
    double value = 0;  ///< NaN if it could not be measured, which does not pass
    bool pass = false;
  };

  struct Comparison {
    bool pass = false;
    std::string
        verdict;  ///< "pass", "differs", or "non-finite": a NaN or an infinity, nothing was measured;
                  ///< of pictures with noise "same", "different" or "undecided"
    std::vector<std::pair<std::string, double>>
        metrics;                 ///< id and value, in the catalogue's order
    std::vector<Judged> limits;  ///< the verdict follows from these
    std::string record;          ///< as `lobelia compare --json` writes it: JSON, kind "comparison"

    /// NaN if it was not measured.
    LOBELIA_API double value(const std::string& metric) const;
  };

  /// Options of `lobelia compare` by name (docs/command_line.md): {{"tolerance", "6e-4,1e-8,3"}, {"all_layers", "true"}}.
  /// One that may be given again may occur again.
  using CompareOptions = std::vector<std::pair<std::string, std::string>>;

  /// Compares `picture` with `reference`, of the same size, as the program does: at an exposure that suits them, by the
  /// default limits of the whole and of the highlight. Like the program it shows them by $OCIO, if that is set. Throws
  /// Error(input) if the sizes differ, Error(usage) for a wrong shape, an unknown metric or a limit out of range.
  LOBELIA_API Comparison compare(const Picture& picture, const Picture& reference,
                                 const CompareSettings& settings = {});
  /// The same with further options. Throws Error(usage) also for those that are for files.
  LOBELIA_API Comparison compare(const Picture& picture, const Picture& reference,
                                 const CompareSettings& settings, const CompareOptions& options);

  /// Compares two files with all that they hold, such as alpha: the verdict is the worst, and `metrics` and `limits` are of
  /// the picture. A file tells how far its integers were rounded, which a Picture does not. Throws Error(input) for a file
  /// that cannot be read, and as compare().
  LOBELIA_API Comparison compare_files(const std::string& picture, const std::string& reference,
                                       const CompareSettings& settings = {},
                                       const CompareOptions& options = {});

  // ---- profile

  /// One highlight. Places are in pixels from the upper left corner, a pixel's centre at a half. Radiance is the mean of
  /// R, G and B. A figure that cannot be measured is NaN; docs/profiles.md defines them.
  struct Highlight {
    double x = 0, y = 0;          ///< of the peak, to a fraction of a pixel
    double peak = 0;              ///< radiance over the background
    double background = 0;        ///< radiance
    double major_half_width = 0;  ///< pixels, along its longer axis
    double minor_half_width = 0;
    double energy = 0;    ///< radiance over the background times pixels, in a disc of 3 half-widths
    std::string problem;  ///< a sentence if there is none or it is doubtful; else empty
  };

  struct Profile {
    std::vector<Highlight> highlights;  ///< the brightest first; empty if the picture has none
    std::string record;  ///< as `lobelia profile --json` writes it: JSON, kind "blobs"
  };

  /// Measures every highlight that has at least `least_share` (0 to 1) of the brightest one's peak. Throws Error(usage).
  LOBELIA_API Profile profile(const Picture& picture, double least_share = 0.1);

  // ---- models and lobes

  struct Lobe {
    std::string name;     ///< "cosine", as in scene files
    std::string title;    ///< for people
    std::string formula;  ///< of s = 1 - cos(angle) and n
  };

  struct Model {
    std::string name, title;
    bool uses_half_vector =
        false;  ///< the lobe's angle is between normal and half vector, else between light and mirror direction
    bool applies_cosine = false;  ///< radiance carries N.L
    bool has_shadowing = false;   ///< and Smith's G / ((N.L) (N.V)) for GGX, alpha^2 = 2 / (n + 2)
  };

  /// The catalogues. Of families such as cs16 only the usual members are listed; every function below knows all.
  LOBELIA_API std::vector<Lobe> lobes();
  LOBELIA_API std::vector<Model> models();
  LOBELIA_API std::vector<std::string> normalisations();

  /// The lobe at `s` = 1 - cos(angle), 0 to 2, for the exponent n, 0 to 1e8: 0 to 1, and 1 at s = 0. In double.
  /// Throws Error(usage).
  LOBELIA_API double lobe_value(const std::string& lobe, double s, double exponent);
  /// The same for many values of `s`, which is quicker.
  LOBELIA_API std::vector<double> lobe_values(const std::string& lobe, const std::vector<double>& s,
                                              double exponent);

  /// The factor of the lobe (and of N.L, where the model applies it) in radiance per unit irradiance, 1/sr. Throws
  /// Error(usage), and Error(input) if the paper prints no coefficient for the lobe.
  LOBELIA_API double coefficient(const std::string& model, const std::string& lobe, double exponent,
                                 const std::string& normalisation = "exact");

}  // namespace v0
}  // namespace lobelia
