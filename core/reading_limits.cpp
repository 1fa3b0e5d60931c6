#include "core/reading_limits.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <thread>
#include <vector>

namespace lobelia {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

/// One more than soft, if that is finite.
void set_limit(int resource, std::uint64_t soft) {
  rlimit limit{};
  ::getrlimit(__rlimit_resource_t(resource), &limit);
  limit.rlim_cur = std::min<rlim_t>(soft, limit.rlim_max);
  ::setrlimit(__rlimit_resource_t(resource), &limit);
}

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // none that is known: nothing is filtered
#endif

/// A program for the kernel: which system calls go through.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
    end(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }
  void allow(long call) {
    add(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 1);
    end(SECCOMP_RET_ALLOW);
  }
  /// Where of the argument's low half the bits of `mask` are `value`.
  void allow_if(long call, int argument, std::uint32_t mask, std::uint32_t value) {
    add(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 5);
    load(std::uint32_t(offsetof(seccomp_data, args)) +
         8 * std::uint32_t(argument));  // little-endian
    add(BPF_ALU | BPF_AND | BPF_K, mask, 0, 0);
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
    end(SECCOMP_RET_ALLOW);
    end(SECCOMP_RET_ERRNO | EPERM);
  }
  void refuse(long call, std::uint32_t error) {
    add(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 1);
    end(SECCOMP_RET_ERRNO | error);
  }
  bool install() {
    end(SECCOMP_RET_ERRNO | EPERM);
    const sock_fprog program{static_cast<unsigned short>(steps_.size()), steps_.data()};
    return kArchitecture != 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  void add(int code, std::uint32_t k, std::uint8_t if_true, std::uint8_t if_false) {
    steps_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, k});
  }
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(offset), 0, 0); }
  void end(std::uint32_t answer) { add(BPF_RET | BPF_K, answer, 0, 0); }
  std::vector<sock_filter> steps_;
};

/// Memory, threads, time, and what is open already: decoders, malloc and pools of threads need no more.
constexpr std::initializer_list<long> kHarmlessCalls[] = {
    // what is open already
    {SYS_read, SYS_pread64, SYS_readv, SYS_write, SYS_writev, SYS_lseek, SYS_fstat, SYS_close},
    // memory
    {SYS_mmap, SYS_munmap, SYS_mremap, SYS_mprotect, SYS_madvise, SYS_brk},
    // threads
    {SYS_futex, SYS_set_robust_list, SYS_set_tid_address, SYS_rseq, SYS_sched_yield,
     SYS_sched_getaffinity, SYS_membarrier, SYS_exit, SYS_exit_group},
    // signals
    {SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_sigaltstack, SYS_restart_syscall},
    // time
    {SYS_clock_gettime, SYS_clock_getres, SYS_clock_nanosleep, SYS_nanosleep, SYS_gettimeofday},
    // itself and the machine
    {SYS_getrandom, SYS_getpid, SYS_gettid, SYS_getrusage, SYS_sysinfo, SYS_uname}};

/// Opening a file and looking at it, by its name.
constexpr long kNameCalls[] = {
    SYS_newfstatat, SYS_statx, SYS_faccessat, SYS_readlinkat, SYS_getcwd,
#ifdef SYS_stat
    SYS_stat,       SYS_lstat, SYS_access,    SYS_readlink,
#endif
};

/// A copy in memory belongs to no file system that Landlock looks at.
void forbid_every_path() {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE |
                                 LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                 LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE;
  const int ruleset =
      int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (ruleset < 0) return;
  ::syscall(SYS_landlock_restrict_self, ruleset, 0);
  ::close(ruleset);
}

/// In the data window and in the display window, together.
std::uint64_t most_pixels(std::uint64_t file_bytes, const PictureLimit& limit) {
  return 2 * (limit.pixels_of_any_file + limit.pixels_per_byte * file_bytes);
}

}  // namespace

std::string claim_problem(const PictureClaim& claim, std::uint64_t file_bytes,
                          const PictureLimit& limit) {
  if (claim.pixels <= most_pixels(file_bytes, limit)) return "";
  const std::string more =
      limit.pixels_per_byte > 0
          ? fmt::format(", and {} more for each byte of the file", limit.pixels_per_byte)
          : "";
  return fmt::format("its header claims {} pixels in a file of {} bytes; allowed here: {}{}",
                     claim.pixels / 2, file_bytes, limit.pixels_of_any_file, more);
}

std::uint64_t memory_to_read(const PictureClaim& claim, std::uint64_t file_bytes) {
  // Values as they are decoded, those of both windows, and one more channel; a picture again for a second look.
  constexpr std::uint64_t kBytesPerPixel = 36;
  // Most libraries unpack all of a picture at once, OpenEXR a few rows.
  const std::uint64_t unpacked = std::min(claim.raw_bytes, 256 * kMebibyte + 64 * file_bytes);
  constexpr std::uint64_t kStack = 9 * kMebibyte;
  return kMemoryToOpen + kBytesPerPixel * claim.pixels + 2 * unpacked + file_bytes +
         kStack * std::max(1u, std::thread::hardware_concurrency());
}

std::uint64_t seconds_to_read(const PictureClaim& claim, std::uint64_t file_bytes) {
  constexpr std::uint64_t kSecondsToOpen = 5, kPixelsPerSecond = 4'000'000;
  const std::uint64_t seconds =
      kSecondsToOpen + claim.pixels / kPixelsPerSecond + file_bytes / (4 * kMebibyte);
  return kSanitized ? 10 * seconds : seconds;
}

std::uint64_t seconds_to_wait(std::uint64_t file_bytes, const PictureLimit& limit) {
  const std::uint64_t pixels =
      std::min<std::uint64_t>(2 * kMaxImagePixels, most_pixels(file_bytes, limit));
  return 60 + 10 * seconds_to_read({pixels, 0}, file_bytes);
}

void limit_memory(std::uint64_t address_space_bytes) {
  if (!kSanitized) set_limit(RLIMIT_AS, address_space_bytes);
}

void limit_processor_time(std::uint64_t seconds) { set_limit(RLIMIT_CPU, seconds); }

bool lock_down(bool may_open_files) {
  set_limit(RLIMIT_FSIZE, 0);
  // 1 and not 0, because a program that the kernel hands dumps to is called at 0 all the same.
  set_limit(RLIMIT_CORE, 1);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  if (may_open_files) forbid_every_path();
  Filter filter;
  for (const auto& calls : kHarmlessCalls)
    for (const long call : calls) filter.allow(call);
  filter.allow_if(SYS_clone, 0, CLONE_THREAD, CLONE_THREAD);
  filter.refuse(SYS_clone3,
                ENOSYS);  // then the C library takes clone, of which the flags can be seen
  filter.allow_if(SYS_tgkill, 0, ~0u, std::uint32_t(::getpid()));  // abort()
  filter.allow_if(SYS_prlimit64, 0, ~0u, 0);                       // its own limits
  if (may_open_files) {
    filter.allow_if(SYS_openat, 2, O_ACCMODE | O_CREAT | O_TRUNC, O_RDONLY);
    for (const long call : kNameCalls) filter.allow(call);
  }
  return filter.install();
}

}  // namespace lobelia
