// What run_process and lobelia_process_keeper tell each other.
#pragma once

#include <cstdint>

namespace lobelia {

inline constexpr char kKeeperFile[] = "lobelia_process_keeper";
/// The keeper's end of a socket of whole messages. Once our end is closed or shut down, it ends all that it keeps.
inline constexpr int kKeeperLine = 3;

/// Sent twice: when the program runs or cannot be started, and when nothing of it runs any more.
struct KeeperReport {
  std::int32_t start_error = 0;       ///< an errno; the keeper ends then
  std::int32_t status = 0;            ///< of the program, as waitpid tells it
  std::int64_t cpu_microseconds = 0;  ///< of all that ran, user and system
  std::int64_t peak_kibibytes = 0;    ///< resident, of the largest
};

}  // namespace lobelia
