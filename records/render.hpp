// Pictures: what a plan decided, how a render and a reference were made.
#pragma once

#include "records/highlight.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

/// The states of an engine: not installed, cannot be driven, can be driven.
inline constexpr std::string_view kEngineStates[] = {"absent", "broken", "ready"};

struct Work {
  std::string unit;
  std::uint64_t count = 0;
  static const Struct& type();
};

struct Effect {
  std::string name;
  bool on = false;
  std::string reason;
  std::optional<Work> work;
  static const Struct& type();
};

struct ExpectedRays {
  std::uint64_t camera = 0, shadow_at_most = 0, mirror_at_most = 0, scattered_at_most = 0;
  static const Struct& type();
};

struct Plan {
  std::vector<Effect> effects;
  std::string precision, kernel;
  ExpectedRays expected_rays;
  static const Struct& type();
};

/// A plan as it stands in the record of a render.
struct PlanOfRender {
  std::vector<Effect> effects;
  std::string precision, kernel;
  static const Struct& type();
};

struct Rays {
  std::uint64_t camera = 0, shadow = 0, mirror = 0, scattered = 0;
  static const Struct& type();
};

struct EngineUsed {
  std::string name, title, version;
  static const Struct& type();
};

struct ImageFile {
  std::string file;
  int width = 0, height = 0;
  static const Struct& type();
};

struct AccuracyChoice {
  std::string lobe;  ///< empty where the highlights keep lobes of their own
  std::string precision;
  std::optional<int> samples;
  static const Struct& type();
};

struct AccuracyOperations {
  double chosen = 0, own_in_float64 = 0;
  static const Struct& type();
};

struct AccuracyReached {
  double value = 0;
  bool held = false;
  std::string against;
  double seconds = 0;
  static const Struct& type();
};

struct Accuracy {
  double asked = 0;
  std::string unit, measure;
  AccuracyChoice chose;
  std::string why;
  AccuracyOperations operations;
  std::string basis;
  double predicted = 0;
  std::optional<AccuracyReached> reached;
  static const Struct& type();
};

struct RenderSeconds {
  double plan = 0, render = 0, total = 0;
  std::optional<double> read, pack, write;
  static const Struct& type();
};

struct Render {
  EngineUsed engine;
  std::vector<std::string> command;
  ImageFile image;
  std::vector<Highlight> highlights;
  int samples = 0;
  std::uint64_t seed = 0;
  std::optional<double> estimated_error;
  std::string stopped;
  std::vector<std::string> remarks;
  PlanOfRender plan;
  Rays rays;
  std::string instruction_set;
  RenderSeconds seconds;
  std::string standard_error;
  std::optional<Accuracy> accuracy;
  static const Struct& type();
};

struct EngineSeconds {
  double total = 0;
  std::optional<double> start, parse, trace, write;
  static const Struct& type();
};

struct Reference {
  EngineUsed engine;
  ImageFile image;
  std::string witness, method;
  std::size_t passes = 0;
  std::optional<int> points;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> engine_commands, engine_options;
  std::optional<bool> writes_limited;
  std::string contained;
  EngineSeconds seconds;
  std::optional<double> cpu_seconds;
  std::optional<std::uint64_t> peak_memory_bytes;
  std::optional<int> threads;
  std::vector<std::string> command;
  std::string standard_error;
  std::vector<Highlight> highlights;
  static const Struct& type();
};

/// An engine of this machine, or of a run.
struct EngineFound {
  std::string name, title;
  bool available = false;
  std::string state, program, version, why, supported_versions, witness, precision, effects,
      install;
  static const Struct& type();
};

struct Engines {
  std::vector<EngineFound> engines;
  static const Struct& type();
};

}  // namespace lobelia::records
