// Compares the pairs of a set, or one pair.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "compare/set/job.hpp"
#include "compare/set/report.hpp"

namespace lobelia {

/// Every pair of the rows, without results: each judged set's picture with the first of its references.
std::vector<PairReport> pairs_of(const Pairing& pairing);

/// Calls work(i) for i < count, in parallel. A thread that waits for a part of its own pair does not start another one,
/// so no more pairs are in memory than there are threads. Those are one more than processors, unless fewer are asked for:
/// a thread waits while another process decodes its picture, and would leave a processor idle each time they take turns.
void for_each_pair(std::size_t count, const std::function<void(std::size_t)>& work);

/// How the files of a compared pair became light, A first: reading_facts(), and the layers that have their noise.
std::array<records::Named<std::string>, 2> reading_of(const PairReport& pair);

/// Reads the pair as it is compared: the part of the chosen layer, or of the mean of its replicates. `job` is that of the
/// pair. Sets what depends on the pictures in `options`. Throws as read_pair().
PicturePair read_compared(const PairReport& pair, const CompareJob& job,
                          ComparisonOptions& options);

/// Reads both files as they are: the chosen layer, whole. Throws as read_pair().
PicturePair read_two(const CompareJob& job, const PairReport& pair);
/// Compares two pictures that were read by read_two(), and cuts them to what is compared, and the files' other layers.
/// `pair` has the files. Throws as compare_pictures() and require_judged_limits() (compare/set/unjudged_limits.hpp).
PairReport compare_two(const CompareJob& job, PairReport pair, PicturePair& pictures);
/// The same of pictures in memory, which messages name as `pair` does. `alpha` is judged where there is one.
PairReport compare_in_memory(const CompareJob& job, PairReport pair, PicturePair& pictures,
                             std::optional<PicturePair> alpha = std::nullopt);

/// Looks at the pictures of a pair that was compared. Called from any thread.
using LookAtPair = std::function<void(const PairReport& pair, const Image& a, const Image& b)>;

/// Compares all pairs, each with the reference that it fits best. A pair that cannot be compared has its error in the
/// report, and the others go on. An automatic range of exposures becomes one that holds those of all references. Throws
/// what `look` throws, if that is no Error(kInput), and as require_judged_limits() does.
///
/// Calls done(pairs so far) after each, from any thread.
SetReport compare_pairs(const CompareJob& job, const Pairing& pairing,
                        const std::function<void(std::size_t)>& done,
                        const LookAtPair& look = nullptr);

/// Throws Error(kInput) unless there is a pair.
void require_pairs(const SetReport& report);

}  // namespace lobelia
