#include "experiments/chaos/fault.hpp"

namespace coop::chaos {

std::string_view name_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::kKill:
      return "kill";
    case FaultKind::kStop:
      return "stop";
    case FaultKind::kSlow:
      return "slow";
    case FaultKind::kLoss:
      return "loss";
    case FaultKind::kCut:
      return "cut";
    case FaultKind::kClock:
      return "clock";
    case FaultKind::kDiskFull:
      return "disk full";
  }
  return "";
}

FaultPlan::FaultPlan(std::uint64_t seed, std::vector<std::string> components, Abilities abilities,
                     double mean_gap)
    : random_(seed, "chaos/faults"), components_(std::move(components)), mean_gap_(mean_gap) {
  using enum FaultKind;
  kinds_ = {kKill, kKill, kKill, kKill, kStop, kStop, kStop, kSlow, kSlow, kClock};
  if (abilities.network) kinds_.insert(kinds_.end(), {kLoss, kLoss, kCut, kCut});
  if (abilities.disk) kinds_.push_back(kDiskFull);
}

Fault FaultPlan::next() {
  // As many numbers for every fault, whatever it is.
  const FaultKind kind = kinds_[random_.below(kinds_.size())];
  const std::string& component = components_[random_.below(components_.size())];
  const double share = random_.uniform();
  const double amount = random_.uniform();
  const bool backwards = random_.below(2) == 0;
  Fault fault{.kind = kind,
              .component = component,
              .duration = 0.0,
              .amount = 0.0,
              .gap = mean_gap_ * random_.uniform(0.5, 1.5)};
  switch (kind) {
    case FaultKind::kKill:
      break;
    case FaultKind::kStop:
      fault.duration = 0.3 + 4.2 * share;
      break;
    case FaultKind::kSlow:
      fault.duration = 2.0 + 2.0 * share;
      break;
    case FaultKind::kLoss:
      fault.duration = 2.0 + 2.0 * share;
      fault.amount = 0.1 + 0.4 * amount;
      break;
    case FaultKind::kCut:
      fault.duration = 0.5 + 5.5 * share;
      fault.amount = 1.0;
      break;
    case FaultKind::kClock:
      fault.component.clear();
      fault.amount = (backwards ? -1.0 : 1.0) * (0.5 + 20.0 * amount);
      break;
    case FaultKind::kDiskFull:
      fault.component.clear();
      fault.duration = 1.0 + 3.0 * share;
      break;
  }
  return fault;
}

bool is_needed_to_drive(const Fault& fault) {
  const bool is_lost = fault.kind == FaultKind::kKill || fault.kind == FaultKind::kStop ||
                       fault.kind == FaultKind::kCut;
  return is_lost && (fault.component == "dwa" || fault.component == "lidar_driver" ||
                     fault.component == "amcl");
}

}  // namespace coop::chaos
