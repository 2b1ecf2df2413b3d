#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.hpp"

namespace coop::chaos {

/// What can befall one component, or all of them at once.
enum class FaultKind {
  kKill,      ///< SIGKILL
  kStop,      ///< SIGSTOP for a while: short, or until the launcher takes it for hanging
  kSlow,      ///< runs a fifth of the time only
  kLoss,      ///< loses a part of its packets, both ways
  kCut,       ///< loses all of them
  kClock,     ///< one sample of /clock from somebody else, seconds off
  kDiskFull,  ///< no space left in the run's folder
};
inline constexpr int kFaultKinds = 7;
[[nodiscard]] std::string_view name_of(FaultKind kind);

struct Fault {
  FaultKind kind = FaultKind::kKill;
  std::string component;  ///< empty where it meets all
  double duration = 0.0;  ///< s of wall time; 0: a moment
  double amount = 0.0;    ///< kLoss: share of packets lost; kClock: s, how far off
  double gap = 0.0;       ///< s of simulated time since the one before was over
};

/// What this machine lets us do.
struct Abilities {
  bool network = false;  ///< a network namespace of our own and iptables
  bool disk = false;     ///< a small file system of our own for the run's folder
};

/// Draws faults: one seed, one row of faults.
class FaultPlan {
 public:
  /// `mean_gap`: s of simulated time between two faults.
  FaultPlan(std::uint64_t seed, std::vector<std::string> components, Abilities abilities,
            double mean_gap);
  [[nodiscard]] Fault next();

 private:
  RandomStream random_;
  std::vector<std::string> components_;
  std::vector<FaultKind> kinds_;  ///< each as often as it is to be drawn
  double mean_gap_;
};

/// Whose loss must make the robot stop: what dwa steers by, and dwa itself.
[[nodiscard]] bool is_needed_to_drive(const Fault& fault);

}  // namespace coop::chaos
