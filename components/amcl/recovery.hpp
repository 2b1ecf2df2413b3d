#pragma once
#include <algorithm>

#include "core/config/fields.hpp"

namespace coop::amcl {

struct RecoveryConfig {
  double slow_rate = 0.01;  ///< an update, decay of the long-term average fit
  double fast_rate = 0.1;   ///< an update, decay of the short-term average fit
  double tolerance = 1.3;   ///< times, by which scans may fit worse before particles are drawn anew
  double max_random_share = 0.3;  ///< of the particles, at most this part is drawn anew

  void describe(config::Fields& fields) {
    fields.number(
        "slow_rate", slow_rate,
        {.help = "decay an update of the long-term fit; 0: no recovery", .min = 0, .max = 1});
    fields.number(
        "fast_rate", fast_rate,
        {.help = "decay an update of the short-term fit; 0: no recovery", .min = 0, .max = 1});
    fields.number("tolerance", tolerance,
                  {.help = "times that scans may fit worse before particles are drawn anew",
                   .min = 1,
                   .max = 100});
    fields.number("max_random_share", max_random_share,
                  {.help = "most particles drawn anew at once", .min = 0, .max = 1});
  }
};

/// Augmented MCL (Probabilistic Robotics, 2005, table 8.3): when the scans fit much worse than they
/// used to, the robot may be elsewhere, and random particles are added by the share
/// max(0, 1 - tolerance * w_fast / w_slow); the factor is that of Gutmann and Fox (An experimental
/// comparison of localization methods continued, IROS 2002), without which every passing animal
/// would draw particles. The fit of a scan is the weighted mean over the particles of the geometric
/// mean likelihood of its beams, in (0, 1].
class Recovery {
 public:
  explicit Recovery(const RecoveryConfig& config) : config_(config) {}

  /// Takes the fit of one scan and returns the share of random particles.
  double update(double fit) {
    if (config_.slow_rate <= 0.0 || config_.fast_rate <= 0.0) return 0.0;
    if (slow_ <= 0.0) {
      slow_ = fast_ = fit;
    } else {
      slow_ += config_.slow_rate * (fit - slow_);
      fast_ += config_.fast_rate * (fit - fast_);
    }
    if (slow_ <= 0.0) return 0.0;
    return std::clamp(1.0 - config_.tolerance * fast_ / slow_, 0.0, config_.max_random_share);
  }
  /// After particles were placed by hand: what fitted before says nothing any more.
  void reset() { slow_ = fast_ = 0.0; }

 private:
  RecoveryConfig config_;
  double slow_ = 0.0;
  double fast_ = 0.0;
};

}  // namespace coop::amcl
