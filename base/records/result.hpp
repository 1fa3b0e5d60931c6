// The records of a cache: results, failures and the content of programs. Also a user's remembered hashes of files.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct Arithmetic {
  std::string libm, kernels, processor;
  bool operator==(const Arithmetic&) const = default;
};

struct ResultInputs {
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string scene, engine_version, engine_content;
  Named<std::string> pictures;  ///< keys of the results that it was made from, by engine
};

struct ResultSeconds {
  double wall = 0, cpu = 0;
};

struct ResultFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::string sha256;
  std::int64_t modified = 0;
};

struct Difference {
  double white_at = 0, relative_to_peak = 0;
};

/// A comparison in a cell.
struct CellComparison {
  std::string a, b, record, png;
  Difference difference;
};

struct Result {
  std::string job, engine, first_made_for;
  ResultInputs inputs;
  Host host;
  int attempts = 0;
  // A render only:
  std::vector<std::string> command;
  std::optional<double> exposure_stops;
  std::optional<Highlight> highlight;
  std::optional<std::vector<std::string>> warnings;
  // A reference only:
  std::optional<std::vector<std::string>> engine_commands;
  std::string shading;
  // A comparison only:
  std::string verdict;
  std::optional<CellComparison> entry;
  std::string not_comparable;
  // A comparison or a profile only: the hash of each picture, by engine.
  std::optional<Named<std::string>> from;
  int threads = 1;
  ResultSeconds seconds;
  std::uint64_t peak_memory_bytes = 0;
  std::string key;
  std::vector<ResultFile> files;

  /// The SHA-256 of one of its files; empty if it has no such file.
  std::string hash_of(const std::string& file) const;
  std::uint64_t bytes() const;  ///< of all files
};

struct Failure {
  std::string job, key, failure, message;
  int attempts = 0;
  Host host;
};

struct ContentFile {
  std::string path;
  std::uint64_t bytes = 0;
  std::string sha256;
};

struct Content {
  std::string sha256;
  std::size_t file_count = 0;
  std::vector<ContentFile> files;
};

struct KnownHashes {
  std::vector<std::array<std::string, 3>> files;  ///< path, identity, SHA-256
};

void define_result_tables(Tables& tables);

}  // namespace lobelia::records
