#include "farm/cache_layout.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <fstream>

#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kParts[] = {"results", "failures", "contents", "making"};

bool is_key(std::string_view name) {
  Sha256Digest digest;
  return from_hex(name, digest);
}

/// Whether it holds nothing but parts of a cache, apart from an NFS client's names for removed files.
bool has_only_our_names(const HeldDirectory& directory) {
  for (const std::string& name : directory.names()) {
    struct stat status {};
    if (name.starts_with(".nfs")) continue;
    if (::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const bool is_part = std::ranges::find(kParts, name) != std::end(kParts);
    if (is_part ? S_ISREG(status.st_mode) : name != kCacheLocksFile || !S_ISREG(status.st_mode))
      return false;
  }
  return true;
}

constexpr std::size_t kMaxHost = 40, kHostHash = 8, kBoot = 32, kRandom = 16;

bool is_hex(std::string_view text) {
  return text.find_first_not_of("0123456789abcdef") == text.npos;
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Several containers or machines may have the same name: the hash of the machine's number tells them apart.
std::string host_part() {
  std::string name = host_name().substr(0, kMaxHost);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return name + "-" + hex(sha256(first_line("/etc/machine-id"))).substr(0, kHostHash);
}

std::string boot_part() {
  std::string boot = first_line("/proc/sys/kernel/random/boot_id");
  std::erase(boot, '-');
  return boot.size() == kBoot && is_hex(boot) ? boot : std::string(kBoot, '0');
}

std::uint64_t pid_namespace() {
  std::error_code ignored;
  const std::string text = fs::read_symlink("/proc/self/ns/pid", ignored).string();  // "pid:[402]"
  std::uint64_t number = 0;
  if (text.starts_with("pid:["))
    std::from_chars(text.data() + 5, text.data() + text.size(), number);
  return number;
}

/// Decimal digits without a sign or zeros before them.
bool parse_number_part(std::string_view text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() &&
         (text.size() == 1 || text[0] != '0');
}

}  // namespace

ProcessIdentity this_process() {
  return {host_part(), boot_part(), pid_namespace(), std::uint64_t(::getpid()),
          stat_of_process("self").start};
}

std::string DraftName::text() const {
  return fmt::format("draft.{}.{}.{}.{}.{}.{}.{:016x}", maker.host, maker.boot, maker.pid_namespace,
                     maker.pid, maker.start, locks_inode, random);
}

std::optional<DraftName> DraftName::parse(std::string_view name) {
  if (name.size() > 200 || std::ranges::count(name, '.') != 7) return std::nullopt;
  const std::vector<std::string> parts = split(name, ".");
  DraftName draft;
  if (parts.size() != 8 || parts[0] != "draft" || parts[1].size() > kMaxHost + 1 + kHostHash ||
      !std::ranges::all_of(
          parts[1], [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; }) ||
      parts[2].size() != kBoot || !is_hex(parts[2]) ||
      !parse_number_part(parts[3], draft.maker.pid_namespace) ||
      !parse_number_part(parts[4], draft.maker.pid) ||
      !parse_number_part(parts[5], draft.maker.start) ||
      !parse_number_part(parts[6], draft.locks_inode) || parts[7].size() != kRandom ||
      !is_hex(parts[7]) || draft.maker.pid == 0 || draft.maker.pid > 0x7fffffff)
    return std::nullopt;
  draft.maker.host = parts[1];
  draft.maker.boot = parts[2];
  std::from_chars(parts[7].data(), parts[7].data() + kRandom, draft.random, 16);
  return draft;
}

bool is_old_draft_name(std::string_view name) { return name.size() == 16 && is_hex(name); }

Life life_of(const ProcessIdentity& maker, const ProcessIdentity& self) {
  const std::string untold(kBoot, '0');
  if (maker.boot == untold || self.boot == untold) return Life::kUnknown;
  if (maker.boot != self.boot) return maker.host == self.host ? Life::kDead : Life::kUnknown;
  if (maker.pid_namespace != self.pid_namespace || !proc_has_our_numbers()) return Life::kUnknown;
  if (::kill(pid_t(maker.pid), 0) != 0 && errno == ESRCH) return Life::kDead;
  const ProcessStat there = stat_of_process(std::to_string(maker.pid));
  if (there.state == 0) return Life::kAlive;  // another user's process, which the system hides
  // A zombie does no work; if process 1 reaps late there are many.
  return there.has_ended() || there.start != maker.start ? Life::kDead : Life::kAlive;
}

bool is_cache_shelf(std::string_view name) { return name.size() == 2 && is_hex(name); }

Owned owned_in_cache(const fs::path& relative) {
  const std::vector<std::string> parts(relative.begin(), relative.end());
  if (parts.size() == 2 && parts[0] == "making")
    return DraftName::parse(parts[1]) || is_old_draft_name(parts[1]) ? Owned::kTree : Owned::kNo;
  if (parts.size() != 3 || !is_cache_shelf(parts[1]) || !parts[2].starts_with(parts[1]))
    return Owned::kNo;
  if (parts[0] == "results" && is_key(parts[2])) return Owned::kTree;
  const fs::path name = parts[2];
  return parts[0] == "failures" && is_key(name.stem().native()) &&
                 (name.extension() == ".json" || name.extension() == ".log")
             ? Owned::kFile
             : Owned::kNo;
}

Ownership cache_ownership() {
  return {[](const HeldDirectory& root) { return root.read(kCacheMarkerFile, 64) == kCacheLayout; },
          owned_in_cache};
}

bool is_cache(const fs::path& directory) {
  const HeldDirectory root(directory);
  if (!root) return false;
  const bool is_begun = !root.names().empty() && has_only_our_names(root);
  return is_begun || root.read(kCacheMarkerFile, 64);
}

void require_cache(const HeldDirectory& root) {
  // Names before the mark: another farm may put it there meanwhile.
  const bool is_begun = has_only_our_names(root);
  if (const auto marker = root.read(kCacheMarkerFile, 64)) {
    if (*marker != kCacheLayout)
      throw Error(ExitCode::kInput, "{}: a cache of another layout; this program reads layout {}",
                  root.path().string(), kCacheLayout.substr(0, 1));
  } else if (!is_begun) {
    throw Error(ExitCode::kInput, "{}: not empty and not a cache (it has no file '{}')",
                root.path().string(), kCacheMarkerFile);
  }
}

HeldDirectory open_cache(const fs::path& directory, ByteLocks::Opening opening) {
  HeldDirectory root(directory);
  if (!root && opening == ByteLocks::Opening::kMake) {
    make_directories(directory);
    root = HeldDirectory(directory);
  }
  if (!root) throw Error(ExitCode::kInput, "{}: {}", directory.string(), root.why_not());
  require_cache(root);
  for (const char* part : kParts) {
    // Fails in a read-only cache, which stays as it is.
    if (opening == ByteLocks::Opening::kMake) ::mkdirat(root.fd(), part, 0777);
    const HeldDirectory there = root.below(part);
    if (!there && !there.is_missing())
      throw Error(ExitCode::kOutput, "{}: {}", there.path().string(), there.why_not());
    for (const std::string& name : there.names())
      if (there.is_link(name))
        throw Error(ExitCode::kOutput, "{}: a symbolic link, which a cache has none of",
                    (there.path() / name).string());
  }
  return root;
}

}  // namespace lobelia
