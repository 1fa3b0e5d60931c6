#include "core/lock_sharing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/text.hpp"

namespace lobelia {
namespace {

struct Mount {
  std::string place, type;
  std::set<std::string, std::less<>> options;  ///< of the mount and of its file system
};

/// "\040" is a blank.
std::string without_escapes(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digits = text.substr(i, 4);
    if (digits.size() == 4 && digits[0] == '\\' &&
        std::ranges::all_of(digits.substr(1), [](char c) { return c >= '0' && c <= '7'; })) {
      plain += char((digits[1] - '0') * 64 + (digits[2] - '0') * 8 + (digits[3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

bool is_below(std::string_view path, std::string_view place) {
  return place == "/" || path == place ||
         (path.starts_with(place) && path.size() > place.size() && path[place.size()] == '/');
}

/// "36 35 98:0 /mnt1 /mnt2 rw,noatime master:1 - ext3 /dev/root rw,errors=continue"
/// Any device, if that is empty.
bool parse(const std::string& line, std::string_view device, Mount& mount) {
  const std::vector<std::string> fields = split(line, " ");
  const auto dash = std::ranges::find(fields, "-");
  if (fields.size() < 6 || (!device.empty() && fields[2] != device) || fields.end() - dash < 4)
    return false;
  mount.place = without_escapes(fields[4]);
  mount.type = dash[1];
  mount.options.clear();
  for (const std::string& list : {fields[5], dash[3]})
    for (std::string& option : split(list, ",")) mount.options.insert(std::move(option));
  return true;
}

LockSharing judge(const Mount& mount) {
  const std::string& type = mount.type;
  const auto is = [&](std::initializer_list<std::string_view> types) {
    return std::ranges::find(types, type) != types.end();
  };
  const auto has = [&](std::initializer_list<const char*> options) -> std::string {
    for (const char* option : options)
      if (mount.options.contains(option)) return option;
    return "";
  };
  const auto local_by = [&](const std::string& option) {
    return LockSharing{false,
                       fmt::format("{} with {}: its locks are this machine's", type, option)};
  };
  const auto kept_by_server = [&] {
    return LockSharing{true, fmt::format("{}, whose machines see each other's locks", type)};
  };
  if (is({"nfs", "nfs4"})) {
    const auto option = has({"nolock", "local_lock=all", "local_lock=posix"});
    return option.empty() ? kept_by_server() : local_by(option);
  }
  if (type == "lustre") {
    if (const auto option = has({"localflock", "noflock"}); !option.empty())
      return local_by(option);
    return has({"flock"}).empty() ? LockSharing{false, "lustre without flock: it has no locks"}
                                  : kept_by_server();
  }
  if (is({"cifs", "smb3"})) return has({"nobrl"}).empty() ? kept_by_server() : local_by("nobrl");
  if (is({"gfs2", "ocfs2"}))
    return has({"localflocks"}).empty() ? kept_by_server() : local_by("localflocks");
  if (is({"ceph", "gpfs"})) return kept_by_server();
  if (type == "fuse" || type.starts_with("fuse.") ||
      is({"9p", "virtiofs", "afs", "beegfs", "orangefs", "pvfs2", "coda", "vboxsf", "prl_fs"}))
    return {false, fmt::format("{}: whether other machines see its locks is not told", type)};
  return {true, fmt::format("{}, a file system of this machine", type)};
}

}  // namespace

LockSharing lock_sharing_of(std::string_view mountinfo, std::string_view device,
                            std::string_view path) {
  Mount best, mount;
  const std::vector<std::string> lines = split(mountinfo, "\n");
  // Some file systems (btrfs) show files another device than their mount.
  for (const std::string_view wanted : {device, std::string_view()}) {
    for (const std::string& line : lines) {
      if (!parse(line, wanted, mount) || (wanted.empty() && !is_below(path, mount.place))) continue;
      // The last one of those at a place hides the others.
      const bool is_above = is_below(path, mount.place), best_is = is_below(path, best.place);
      if (best.type.empty() || (is_above && (!best_is || mount.place.size() >= best.place.size())))
        best = mount;
    }
    if (!best.type.empty()) break;
  }
  if (best.type.empty()) return {false, "its file system is not among the mounts"};
  return judge(best);
}

}  // namespace lobelia
