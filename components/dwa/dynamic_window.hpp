#pragma once
#include <vector>

#include "core/vehicle/ackermann.hpp"
#include "dwa/config.hpp"

namespace coop::dwa {

/// How the base moves now: what its next moment can reach depends on both.
struct MotionState {
  double speed = 0.0;     ///< m/s, negative: backwards
  double steering = 0.0;  ///< rad, of the virtual middle front wheel
};

/// Element of the set A of equation (8), as speed and steering angle; omega follows from both.
struct Command {
  double speed = 0.0;     ///< m/s
  double steering = 0.0;  ///< rad
};

/// Equations (7) and (8): the velocities that can be reached within the window's time from the
/// present motion, sampled, and their Cartesian product.
///
///   v_i     from max(v_low,  v - a T) to min(v_high, v + a T), m + 1 values
///   omega_j from the steering angles within delta -+ rate T and the steering limit, n + 1 values
///
/// Deviation: the paper samples omega itself. An Ackermann base reaches |omega| <= |v| / R_min
/// only, and how fast omega changes follows from the steering rate, so the samples are equidistant
/// in the steering angle and omega = v tan(delta) / wheelbase; both limits then hold by
/// construction.
class DynamicWindow {
 public:
  /// `steering_rate` in rad/s.
  DynamicWindow(const WindowConfig& config, double acceleration,
                const vehicle::AckermannGeometry& base, double steering_rate);

  /// Fills `commands`, ordered by speed, then steering angle. `low` and `high` bound the speed.
  /// Where the present speed lies so far outside that neither can be reached, the reachable speed
  /// nearest to them is the only one. The steering angle `wish`, clamped to what can be reached, is
  /// sampled in addition.
  void sample(const MotionState& now, double low, double high, double wish,
              std::vector<Command>& commands) const;

 private:
  WindowConfig config_;
  double acceleration_;
  double steering_rate_;
  double max_steering_;
};

}  // namespace coop::dwa
