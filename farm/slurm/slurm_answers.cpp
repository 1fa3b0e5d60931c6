#include "farm/slurm/slurm_answers.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>

#include "base/words/text.hpp"
#include "farm/slurm/slurm_options.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMostTasks = 4'000'000;  // Slurm's own limit of MaxArraySize is 4 000 001

std::optional<std::size_t> digits(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::optional<SlurmJobId> job_id(std::string_view text) {
  const auto value = digits(text);
  // The highest ids mean "none" and "federated" to Slurm.
  if (!value || *value == 0 || *value >= 0xfffffff0u) return {};
  return SlurmJobId(*value);
}

/// "RUNNING", "REQUEUE_HOLD"
bool is_state_name(std::string_view text) {
  return !text.empty() && text.size() <= 32 &&
         text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == text.npos;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

SlurmElement::State state_of(std::string_view name) {
  if (is_one_of(name, {"PENDING", "REQUEUED", "REQUEUE_HOLD", "REQUEUE_FED", "SPECIAL_EXIT",
                       "RESV_DEL_HOLD"}))
    return SlurmElement::State::kPending;
  if (is_one_of(name, {"COMPLETED", "CANCELLED", "FAILED", "TIMEOUT", "NODE_FAIL", "PREEMPTED",
                       "BOOT_FAIL", "DEADLINE", "OUT_OF_MEMORY", "REVOKED"}))
    return SlurmElement::State::kEnded;
  // An unknown state of a newer Slurm counts as running: its element leaves the queue at its end.
  return SlurmElement::State::kRunning;
}

/// "idle~" is switched off and starts on demand; "idle*" and "down*" do not answer.
bool is_usable(std::string_view state) {
  const auto suffix = std::min(state.find_first_of("*~#!%$@^-+"), state.size());
  return state.substr(suffix) != "*" &&
         is_one_of(state.substr(0, suffix),
                   {"idle", "alloc", "mix", "comp", "plnd", "resv", "boot", "npc", "pow_up"});
}

bool is_message(std::string_view line) {
  return line.starts_with("squeue: ") || line.starts_with("sinfo: ") ||
         line.starts_with("scontrol: ");
}

using Fields = std::vector<std::string_view>;

/// Splits at bars into exactly `count` fields; the field before the last `tail` ones may contain bars.
std::optional<Fields> fields(std::string_view line, std::size_t count, std::size_t tail) {
  Fields result, last;
  while (result.size() + 1 + tail < count) {
    const auto bar = line.find('|');
    if (bar == line.npos) return {};
    result.push_back(line.substr(0, bar));
    line.remove_prefix(bar + 1);
  }
  while (last.size() < tail) {
    const auto bar = line.rfind('|');
    if (bar == line.npos) return {};
    last.push_back(line.substr(bar + 1));
    line = line.substr(0, bar);
  }
  result.push_back(line);
  result.insert(result.end(), last.rbegin(), last.rend());
  return result;
}

/// A T for each line that is no message; `fill` returns whether it understands the fields.
template <class T, class Fill>
std::optional<std::vector<T>> parse_lines(std::span<const std::string> lines, std::size_t count,
                                          std::size_t tail, Fill fill) {
  std::vector<T> result;
  for (const std::string& line : lines) {
    if (is_message(line)) continue;
    const auto field = fields(line, count, tail);
    if (!field || !fill(*field, result.emplace_back())) return {};
  }
  return result;
}

/// "main*": a star marks the default partition.
std::string partition_name(std::string_view field, bool& is_default) {
  is_default = field.ends_with('*');
  if (is_default) field.remove_suffix(1);
  return printable(field);
}

/// "1/3/0/4": allocated, idle, other, all. The first two count.
std::optional<std::size_t> usable_processors(std::string_view text) {
  const std::vector<std::string> parts = split(text, "/");
  std::size_t usable = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto value = digits(parts[i]);
    if (!value) return {};
    if (i < 2) usable += std::min(*value, kMostTasks);
  }
  return parts.size() == 4 ? std::optional(usable) : std::nullopt;
}

/// "3", "3-9", "1-9:2"
std::optional<std::size_t> count_of_range(std::string_view text) {
  const auto dash = text.find('-');
  if (dash == text.npos) return digits(text) ? std::optional<std::size_t>(1) : std::nullopt;
  const auto colon = text.find(':', dash);
  const auto first = digits(text.substr(0, dash));
  const auto last = digits(text.substr(dash + 1, colon == text.npos ? colon : colon - dash - 1));
  const auto step =
      colon == text.npos ? std::optional<std::size_t>(1) : digits(text.substr(colon + 1));
  if (!first || !last || !step || *last < *first || *last > kMostTasks || *step == 0) return {};
  return (*last - *first) / *step + 1;
}

}  // namespace

SlurmEnding end_of(const SlurmElement& element) {
  constexpr std::pair<std::string_view, SlurmEnding> ends[] = {
      {"COMPLETED", SlurmEnding::kWell},       {"TIMEOUT", SlurmEnding::kTime},
      {"OUT_OF_MEMORY", SlurmEnding::kMemory}, {"NODE_FAIL", SlurmEnding::kNode},
      {"BOOT_FAIL", SlurmEnding::kNode},       {"PREEMPTED", SlurmEnding::kPreempted},
      {"REVOKED", SlurmEnding::kPreempted},    {"DEADLINE", SlurmEnding::kDeadline},
      {"CANCELLED", SlurmEnding::kCancelled}};
  for (const auto& [name, end] : ends)
    if (name == element.state_name) return end;
  return SlurmEnding::kFailed;
}

std::string_view words_for(SlurmEnding end) {
  constexpr std::string_view words[] = {"",
                                        "",
                                        "time limit reached",
                                        "more memory used than asked for",
                                        "node lost",
                                        "room made for other jobs",
                                        "deadline missed (--deadline)",
                                        "cancelled by somebody else"};
  return words[std::size_t(end)];
}

bool tells_of_memory(std::string_view line) {
  constexpr std::string_view signs[] = {"exceeded memory limit", "Exceeded job memory limit",
                                        "oom-kill event", "oom_kill event"};
  return line.starts_with("slurmstepd") && std::ranges::any_of(signs, [&](std::string_view sign) {
           return line.find(sign) != line.npos;
         });
}

bool is_node_name(std::string_view text) {
  const auto alphanumeric = [](unsigned char c) { return std::isalnum(c) != 0; };
  return !text.empty() && text.size() <= 64 && alphanumeric(text.front()) &&
         std::ranges::all_of(
             text, [&](char c) { return alphanumeric(c) || c == '-' || c == '_' || c == '.'; });
}

std::optional<std::size_t> count_of_array_tasks(std::string_view text) {
  if (text == "N/A") return 1;
  if (text.starts_with('[') != text.ends_with(']') || text.size() > 65536) return {};
  if (text.starts_with('[')) text = text.substr(1, text.size() - 2);
  if (const auto percent = text.rfind('%'); percent != text.npos) {
    if (!digits(text.substr(percent + 1))) return {};
    text = text.substr(0, percent);
  }
  std::size_t count = 0;
  while (true) {
    const auto comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    // squeue's form of a long list.
    const bool shortened = part == "..." && comma == text.npos && count > 0;
    const auto more = shortened ? std::optional<std::size_t>(0) : count_of_range(part);
    if (!more || (count += *more) > kMostTasks) return {};
    if (comma == text.npos) return count;
    text.remove_prefix(comma + 1);
  }
}

std::optional<SlurmJobId> parse_submission(std::span<const std::string> lines) {
  std::optional<SlurmJobId> result;
  for (const std::string& line : lines) {
    const auto id = job_id(std::string_view(line).substr(0, line.find(';')));
    if (!id) continue;
    if (result) return {};  // two answers are none
    result = id;
  }
  return result;
}

std::optional<std::vector<SlurmElement>> parse_elements(std::span<const std::string> lines) {
  return parse_lines<SlurmElement>(lines, 4, 1, [](const Fields& field, SlurmElement& element) {
    const auto count = count_of_array_tasks(field[0]);
    if (!count || !is_state_name(field[1])) return false;
    element = {state_of(field[1]),    *count,
               std::string(field[1]), printable(field[2], 200),
               printable(field[3]),   digits(field[0])};
    return true;
  });
}

std::optional<std::vector<SlurmLivingJob>> parse_living_jobs(std::span<const std::string> lines) {
  auto jobs =
      parse_lines<SlurmLivingJob>(lines, 3, 0, [](const Fields& field, SlurmLivingJob& job) {
        const auto id = job_id(field[0]);
        if (!id || !is_state_name(field[1])) return false;
        job = {*id, std::string(field[1]), printable(field[2], 200)};
        return true;
      });
  if (!jobs) return {};
  std::erase_if(*jobs, [](const SlurmLivingJob& job) {
    return state_of(job.state_name) == SlurmElement::State::kEnded;
  });
  std::ranges::stable_sort(*jobs, {}, &SlurmLivingJob::id);
  const auto repeated = std::ranges::unique(*jobs, {}, &SlurmLivingJob::id);
  jobs->erase(repeated.begin(), repeated.end());
  return jobs;
}

std::optional<std::vector<SlurmNode>> parse_node_list(std::span<const std::string> lines) {
  return parse_lines<SlurmNode>(lines, 6, 0, [](const Fields& field, SlurmNode& node) {
    std::string_view memory = field[4];
    if (memory.ends_with('+')) memory.remove_suffix(1);
    const auto mebibytes = digits(memory), processors = usable_processors(field[5]);
    node.partition = partition_name(field[1], node.is_default);
    if (!is_node_name(field[0]) || node.partition.empty() || field[3].empty() || !mebibytes ||
        !processors)
      return false;
    const bool up = field[2] == "up";
    node.name = field[0];
    node.state = printable(field[3]) + (up ? "" : " in a partition that is down");
    node.usable = up && is_usable(field[3]);
    node.mebibytes = (long long)std::min<std::size_t>(*mebibytes, 1'000'000'000);
    node.processors = *processors;
    return true;
  });
}

std::optional<SlurmPartition> parse_partition(std::span<const std::string> lines) {
  SlurmPartition result;
  bool is_one = false;
  for (const std::string& line : lines) {
    if (is_message(line)) continue;
    for (const std::string& word : split(line, " \t")) {
      const std::string_view text = word;
      is_one = is_one || text.starts_with("PartitionName=");
      if (text.starts_with("MaxTime="))
        result.most_seconds = parse_slurm_time(text.substr(8));
      else if (text.starts_with("MaxMemPerNode="))
        result.most_mebibytes = parse_slurm_memory(text.substr(14));
    }
  }
  if (!is_one) return {};
  return result;
}

std::optional<std::map<std::string, std::string>> parse_config(std::span<const std::string> lines) {
  std::map<std::string, std::string> result;
  for (const std::string& line : lines) {
    const auto equals = line.find(" = ");
    if (equals == line.npos) continue;
    const auto key = split(std::string_view(line).substr(0, equals), " \t");
    if (key.size() == 1) result.emplace(key.front(), printable(line.substr(equals + 3), 200));
  }
  if (result.empty()) return {};
  return result;
}

long long config_number(const std::map<std::string, std::string>& config, const std::string& key,
                        long long otherwise) {
  const auto found = config.find(key);
  long long value = 0;
  if (found == config.end() ||
      !parse_integer(std::string_view(found->second).substr(0, found->second.find(' ')), value))
    return otherwise;
  return value;
}

bool waits_for_somebody(const SlurmElement& element) {
  return element.state == SlurmElement::State::kPending &&
         (is_one_of(element.state_name, {"REQUEUE_HOLD", "SPECIAL_EXIT", "RESV_DEL_HOLD"}) ||
          waits_for_somebody(element.reason));
}

bool waits_for_somebody(std::string_view reason) {
  // job_reason_string() of Slurm's slurm_protocol_defs.c; the controller itself sets "launch failed requeued held".
  return is_one_of(reason, {"JobHeldUser", "JobHeldAdmin", "PartitionDown", "PartitionInactive",
                            "BadConstraints", "InvalidAccount", "InvalidQOS",
                            "DependencyNeverSatisfied", "AccountNotAllowed", "QOSNotAllowed"}) ||
         reason.ends_with(" held");
}

}  // namespace lobelia
