// How often the figures of profiles lie within their stated errors of the truth, by kind of picture.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/records/profile.hpp"
#include "base/records/verify.hpp"
#include "profile/profile.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::profile_study {

/// Counts for one figure over all pictures of a kind.
struct Tally {
  int figures = 0;     ///< that have a standard error
  int within_one = 0;  ///< standard error of the truth
  int within_two = 0;
  int missing = 0;                     ///< not measured, or without a standard error
  std::vector<double> distances = {};  ///< from the truth, in standard errors
  std::vector<double> errors = {};     ///< stated, as shares of the true value or in pixels

  void add(double found, double truth, double error, double unit);
  double share() const {
    return figures + missing > 0 ? double(within_two) / (figures + missing) : 0;
  }
  double worst() const;  ///< the largest distance; 0 if there is none
};

struct Row {
  std::string kind;
  int pictures = 0;
  std::map<std::string, Tally> figures;  ///< by name

  /// Over all figures.
  double share() const;
  /// The distance from the truth that half of the figures have at most: 0.67 if errors are normal and stated rightly, less
  /// where they are stated too large. NaN if there are none.
  double median_distance() const;
};

/// At least this share of each kind is to lie within two stated errors.
inline constexpr double kGoal = 0.95;

struct Options {
  int pictures = 60;  ///< of each kind
  unsigned seed = 1;
  std::string only = {};  ///< the kind of this name; empty: all
};

/// Gives the thorough profile of the first light on the scene's first sphere, in these pictures.
using ProfileOfScene = std::function<records::Profile(const Scene&, const NamedImages&)>;

/// `show` is called with the share that is done, from one thread. Pictures are measured on several threads; the result does
/// not depend on them.
std::vector<Row> measure(const Options& options, const ProfileOfScene& profile_of,
                         const std::function<void(double)>& show);

std::string report_text(const std::vector<Row>& rows, bool markdown);
bool meets_goal(const std::vector<Row>& rows);
records::VerifyProfiles report_record(const std::vector<Row>& rows, unsigned seed);

}  // namespace lobelia::profile_study
