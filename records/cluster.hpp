// A run of a farm on a cluster: what its elements are given and tell.
#pragma once

#include "records/farm.hpp"
#include "records/result.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

struct ChunkLimits {
  double time_limit = 0, no_progress_limit = 0;
  int attempts = 0;
  std::uint64_t memory = 0, disk = 0;
  int give_up_after = 0;
  static const Struct& type();
};

struct ChunkEngine {
  std::string name, version, content, program;
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
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string cache;
  ChunkLimits limits;
  std::optional<std::string> failed;
  std::vector<ChunkEngine> engines;
  std::vector<ChunkCell> cells;
  static const Struct& type();
};

struct LeftUndone {
  std::string engine, why;
  static const Struct& type();
};

struct FarmChunkReport {
  std::string node;
  std::vector<LeftUndone> left;
  static const Struct& type();
};

struct FarmRun {
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string grid, directory, cache;
  std::vector<std::string> command;
  std::string gallery;
  Named<std::string> programs;
  static const Struct& type();
};

struct SlurmArray {
  std::uint32_t job = 0;
  std::size_t first_chunk = 0, chunks = 0;
  int phase = 0, round = 0;
  std::string time, memory;
  static const Struct& type();
};

struct SlurmRun {
  std::string name;
  int round = 0;
  std::size_t next_chunk = 0, first_report = 0;
  std::vector<SlurmArray> arrays;
  static const Struct& type();
};

struct SlurmDoctor {
  std::string host, version, token, rename, link, lock;
  static const Struct& type();
};

}  // namespace lobelia::records
