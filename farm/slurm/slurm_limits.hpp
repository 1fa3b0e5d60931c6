// Time and memory of an element as sbatch takes them, and twice as much.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "farm/slurm/slurm_options.hpp"

namespace lobelia {

/// Seconds of "90" (minutes), "90:30", "1:30:00", "2-12", "2-12:30" or "2-12:30:00". Empty for anything else, also for no
/// limit ("UNLIMITED", "0").
std::optional<long long> parse_slurm_time(std::string_view text);
/// "1:30:00", "2-12:30:00"
std::string slurm_time_text(long long seconds);

/// Mebibytes of "4000", "4000M", "4G", "1T" or "512K" (rounded up). Empty for anything else, also for "0" (all of a node's).
std::optional<long long> parse_slurm_memory(std::string_view text);
/// "4G", "1500M"
std::string slurm_memory_text(long long mebibytes);

/// The same request with --time, --mem and --exclude in their own fields, where they were raw options.
SlurmOptions with_own_fields(SlurmOptions options);

/// Twice a request, at most `most`. Empty where it already is `most`.
std::optional<long long> twice_at_most(long long asked, std::optional<long long> most);

}  // namespace lobelia
