// A run of a farm on a cluster: input and reports of its array elements.
#pragma once

#include "base/records/farm.hpp"
#include "base/records/outside_engine.hpp"
#include "base/records/result.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct ChunkLimits {
  double time_limit = 0, no_progress_limit = 0;
  int attempts = 0;
  std::uint64_t memory = 0, disk = 0;
  int give_up_after = 0;
};

struct ChunkEngine {
  std::string name, version, content, program;
  std::optional<OutsideEngine> outside;
};

struct ChunkCell {
  std::string id;
  std::vector<std::string> engines;
  Named<std::string> axes;
  std::string scene;
  std::vector<std::string> jobs;
};

struct FarmChunk {
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string cache;
  ChunkLimits limits;
  std::optional<std::string> failed;
  std::vector<ChunkEngine> engines;
  std::string truth;
  std::optional<bool> ours;
  std::vector<ChunkCell> cells;
};

struct LeftUndone {
  std::string engine, why;
};

struct FarmChunkReport {
  std::string node;
  std::vector<LeftUndone> left;
};

struct FarmRun {
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string grid, directory, cache;
  std::vector<std::string> command;
  std::string gallery;
  Named<std::string> programs;
};

struct SlurmArray {
  std::uint32_t job = 0;
  std::size_t first_chunk = 0, chunks = 0;
  int phase = 0, round = 0;
  std::string time, memory;
};

struct SlurmRun {
  std::string name;
  int round = 0;
  std::size_t next_chunk = 0, first_report = 0;
  std::vector<SlurmArray> arrays;
};

struct SlurmDoctor {
  std::string host, version, token, rename, link, lock;
};

void define_cluster_tables(Tables& tables);

}  // namespace lobelia::records
