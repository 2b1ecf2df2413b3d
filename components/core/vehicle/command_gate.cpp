#include "core/vehicle/command_gate.hpp"

#include <cmath>

namespace coop::vehicle {

const char* to_string(DriveCause cause) {
  switch (cause) {
    case DriveCause::kCommand:
      return "command";
    case DriveCause::kNoCommand:
      return "no command yet";
    case DriveCause::kCommandStale:
      return "commands stopped coming";
    case DriveCause::kEmergencyStop:
      return "emergency stop";
  }
  return "";
}

void EmergencyStops::set(const std::string& source, bool engaged, const std::string& reason) {
  if (engaged) {
    reasons_[source] = reason;
  } else {
    reasons_.erase(source);
  }
}

std::string EmergencyStops::description() const {
  if (reasons_.empty()) return {};
  const auto& [source, reason] = *reasons_.begin();
  return source + ": " + reason;
}

void CommandGateConfig::describe(config::Fields& fields) {
  fields.number("command_timeout", command_timeout,
                {.unit = "s",
                 .help = "the base stops when no velocity command came for this long",
                 .min = 0.02,
                 .max = 5});
}

CommandGate::CommandGate(const CommandGateConfig& config)
    : timeout_(seconds(config.command_timeout)) {}

bool CommandGate::accept(const Twist2& command, Time received) {
  if (!std::isfinite(command.v) || !std::isfinite(command.omega)) return false;
  last_ = Received{command, received};
  return true;
}

CommandGate::Decision CommandGate::decide(Time now) const {
  if (stops_.engaged()) return {{}, DriveCause::kEmergencyStop};
  if (!last_) return {{}, DriveCause::kNoCommand};
  // A clock that was set back makes no command young again.
  if (now < last_->at || now - last_->at > timeout_) return {{}, DriveCause::kCommandStale};
  return {last_->command, DriveCause::kCommand};
}

}  // namespace coop::vehicle
