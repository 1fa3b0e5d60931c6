// The protocol between run_process and lobelia_process_keeper.
#pragma once

#include <cstdint>

namespace lobelia {

inline constexpr char kKeeperFile[] = "lobelia_process_keeper";
/// The keeper's end of a socket of packets. When our end is closed or shut down, the keeper ends everything.
inline constexpr int kKeeperLine = 3;

/// Sent twice: when the program runs or cannot be started, and when everything has ended.
struct KeeperReport {
  std::int32_t start_error = 0;       ///< an errno; the keeper ends then
  std::int32_t status = 0;            ///< of the program, as of waitpid
  std::int64_t cpu_microseconds = 0;  ///< of all processes, user and system
  std::int64_t peak_kibibytes = 0;    ///< resident, of the largest process
};

}  // namespace lobelia
