#include "arm_driver/simulated_arm.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace coop::arm_driver {
namespace {

constexpr double kHeldVacuum = 60.0;  // kPa
constexpr double kOpenVacuum = 6.0;   // kPa that the pump reaches on the open cup
/// Longest step of the servos, s: after a pause of the driver they do not jump.
constexpr double kLongestStep = 0.1;

}  // namespace

/// Written over itself at every change; small enough to be written as a whole although the process
/// may be killed at any time. A half-written file of a crashed machine is told by the check.
struct SimulatedArm::Memory {
  std::uint64_t format = 0x31304D5241504F43;  // "COPARM01"
  std::int32_t joints = 0;
  std::int32_t suction = 0;
  double positions[kMaxJoints] = {};
  double check = 0.0;  ///< sum of the positions

  [[nodiscard]] bool operator==(const Memory&) const = default;
};

SimulatedArm::SimulatedArm(const KinematicChain& chain, const JointVector& start,
                           const std::filesystem::path& memory)
    : chain_(chain), positions_(start), velocities_(JointVector::Zero(chain.size())) {
  if (memory.empty()) return;
  if (memory.has_parent_path()) std::filesystem::create_directories(memory.parent_path());
  file_ = ::open(memory.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), memory.string());
  if (!recall()) remember();
}

SimulatedArm::~SimulatedArm() {
  if (file_ >= 0) ::close(file_);
}

SimulatedArm::Memory SimulatedArm::memory() const {
  Memory memory;
  memory.joints = chain_.size();
  memory.suction = suction_ ? 1 : 0;
  for (int i = 0; i < chain_.size(); ++i) memory.positions[i] = positions_[i];
  for (const double position : memory.positions) memory.check += position;
  return memory;
}

void SimulatedArm::remember() const {
  if (file_ < 0) return;
  const Memory memory = this->memory();
  // A full disk costs the memory, not the arm.
  [[maybe_unused]] const auto written = ::pwrite(file_, &memory, sizeof memory, 0);
}

bool SimulatedArm::recall() {
  Memory stored;
  if (::pread(file_, &stored, sizeof stored, 0) != static_cast<ssize_t>(sizeof stored)) {
    return false;
  }
  const JointVector start = positions_;
  for (int i = 0; i < chain_.size(); ++i) positions_[i] = stored.positions[i];
  suction_ = stored.suction == 1;
  if (memory() == stored && chain_.within_limits(positions_)) return true;
  positions_ = start;
  suction_ = false;
  return false;
}

void SimulatedArm::hear_truth(bool egg_in_gripper, Time now) {
  egg_in_gripper_ = egg_in_gripper;
  heard_ = now;
}

ArmReading SimulatedArm::read(Time now) {
  ArmReading reading{positions_, velocities_, suction_, suction_ ? kOpenVacuum : 0.0, {}};
  // Time set back: the simulation began anew, and what was heard before belongs to the old one.
  if (heard_ && (*heard_ > now || now - *heard_ > seconds(kTruthLifetime))) heard_.reset();
  if (!heard_) return reading;
  reading.vacuum = egg_in_gripper_;
  if (egg_in_gripper_) reading.vacuum_kpa = kHeldVacuum;
  return reading;
}

void SimulatedArm::command(const JointVector& target, bool suction, Time now) {
  const double passed = moved_ ? to_seconds(now - *moved_) : 0.0;
  moved_ = now;
  const double dt = std::clamp(passed, 0.0, kLongestStep);
  const JointVector reach = dt * chain_.max_velocity();
  const JointVector goal = target.cwiseMax(chain_.lower()).cwiseMin(chain_.upper());
  const JointVector step = (goal - positions_).cwiseMax(-reach).cwiseMin(reach);
  const bool changed = suction != suction_ || (step.array() != 0.0).any();
  positions_ += step;
  suction_ = suction;
  if (dt > 0.0) velocities_ = step / dt;
  if (changed) remember();
}

}  // namespace coop::arm_driver
