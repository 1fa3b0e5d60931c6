#include "base/pictures/reading_limits.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <thread>

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
  const std::unique_ptr<void, decltype(&::seccomp_release)> filter(
      ::seccomp_init(SCMP_ACT_ERRNO(EPERM)), &::seccomp_release);
  bool is_complete = filter && ::seccomp_attr_set(filter.get(), SCMP_FLTATR_ACT_BADARCH,
                                                  SCMP_ACT_KILL_PROCESS) == 0;
  const auto add = [&](std::uint32_t action, long call,
                       std::initializer_list<scmp_arg_cmp> arguments = {}) {
    is_complete =
        is_complete && ::seccomp_rule_add_array(filter.get(), action, int(call),
                                                unsigned(arguments.size()), arguments.begin()) == 0;
  };
  /// Where of the argument's low half the bits of `mask` are `value`.
  const auto allow_if = [&](long call, unsigned argument, std::uint32_t mask, std::uint32_t value) {
    add(SCMP_ACT_ALLOW, call, {scmp_arg_cmp{argument, SCMP_CMP_MASKED_EQ, mask, value}});
  };
  for (const auto& calls : kHarmlessCalls)
    for (const long call : calls) add(SCMP_ACT_ALLOW, call);
  allow_if(SYS_clone, 0, CLONE_THREAD, CLONE_THREAD);
  // Then the C library takes clone, of which the flags can be seen.
  add(SCMP_ACT_ERRNO(ENOSYS), SYS_clone3);
  allow_if(SYS_tgkill, 0, ~0u, std::uint32_t(::getpid()));  // abort()
  allow_if(SYS_prlimit64, 0, ~0u, 0);                       // its own limits
  if (may_open_files) {
    allow_if(SYS_openat, 2, O_ACCMODE | O_CREAT | O_TRUNC, O_RDONLY);
    for (const long call : kNameCalls) add(SCMP_ACT_ALLOW, call);
  }
  return is_complete && ::seccomp_load(filter.get()) == 0;
}

}  // namespace lobelia
