// A run of a farm on a cluster: what its elements are given and tell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/farm.hpp"
#include "records/result.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

struct ChunkLimits {
  double time_limit = 0;
  double no_progress_limit = 0;
  int attempts = 0;
  std::uint64_t memory = 0;
  std::uint64_t disk = 0;
  int give_up_after = 0;
  static const Struct& type();
};

struct ChunkEngine {
  std::string name;
  std::string version;
  std::string content;
  std::string program;
  static const Struct& type();
};

struct ChunkCell {
  std::string id;
  std::vector<std::string> engines;
  std::string scene;
  std::vector<std::string> jobs;
  static const Struct& type();
};

struct FarmChunk {
  std::string program;
  std::string libraries;
  Arithmetic arithmetic;
  std::string cache;
  ChunkLimits limits;
  std::optional<std::string> failed;
  std::vector<ChunkEngine> engines;
  std::vector<ChunkCell> cells;
  static const Struct& type();
};

struct LeftUndone {
  std::string engine;
  std::string why;
  static const Struct& type();
};

struct FarmChunkReport {
  std::string node;
  std::vector<LeftUndone> left;
  static const Struct& type();
};

struct FarmRun {
  std::string program;
  std::string libraries;
  Arithmetic arithmetic;
  std::string grid;
  std::string directory;
  std::string cache;
  std::vector<std::string> command;
  std::string gallery;
  Named<std::string> programs;
  static const Struct& type();
};

struct SlurmArray {
  std::uint32_t job = 0;
  std::size_t first_chunk = 0;
  std::size_t chunks = 0;
  int phase = 0;
  int round = 0;
  std::string time;
  std::string memory;
  static const Struct& type();
};

struct SlurmRun {
  std::string name;
  int round = 0;
  std::size_t next_chunk = 0;
  std::size_t first_report = 0;
  std::vector<SlurmArray> arrays;
  static const Struct& type();
};

struct SlurmDoctor {
  std::string host;
  std::string version;
  std::string token;
  std::string rename;
  std::string link;
  std::string lock;
  static const Struct& type();
};

}  // namespace lobelia::records
