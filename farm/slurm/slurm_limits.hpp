// Time and memory of an element as sbatch takes them, and twice as much.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "farm/slurm/slurm_options.hpp"

namespace lobelia {

/// Seconds of "90" (minutes), "90:30", "1:30:00", "2-12", "2-12:30" or "2-12:30:00". Nothing for what means no
/// limit ("UNLIMITED", "0") and for what is none of these.
std::optional<long long> parse_slurm_time(std::string_view text);
/// "1:30:00", "2-12:30:00"
std::string slurm_time_text(long long seconds);

/// Mebibytes of "4000", "4000M", "4G", "1T" or "512K" (rounded up). Nothing for "0" (all that a node has) and for what
/// is none of these.
std::optional<long long> parse_slurm_memory(std::string_view text);
/// "4G", "1500M"
std::string slurm_memory_text(long long mebibytes);

/// The same request with --time, --mem and --exclude in their own fields, where they were raw options.
SlurmOptions with_own_fields(SlurmOptions options);

/// What a request becomes after it was too small: twice of it, at most `most`. Nothing where it already is `most`.
std::optional<long long> twice_at_most(long long asked, std::optional<long long> most);

}  // namespace lobelia
