#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop::vehicle {

/// Why the base does what it does.
enum class DriveCause : std::uint8_t {
  kCommand,        ///< follows a fresh command
  kNoCommand,      ///< none has come yet
  kCommandStale,   ///< the last one is older than the watchdog's timeout
  kEmergencyStop,  ///< at least one source has it engaged
};

/// "command", "no command yet", ...: for status texts.
[[nodiscard]] const char* to_string(DriveCause cause);

/// The emergency stop of all sources: in force while any source has it engaged. A source that dies
/// leaves its stop in force; only the same source releases it.
class EmergencyStops {
 public:
  void set(const std::string& source, bool engaged, const std::string& reason);
  [[nodiscard]] bool engaged() const { return !reasons_.empty(); }
  /// "source: reason" of the first source in order of names, empty where none is engaged.
  [[nodiscard]] std::string description() const;

 private:
  std::map<std::string, std::string> reasons_;
};

struct CommandGateConfig {
  double command_timeout = 0.3;  ///< s

  void describe(config::Fields& fields);
};

/// Decides which velocity command is in force: the watchdog over cmd_vel and the emergency stop in
/// one place. Without a fresh command, or under an emergency stop, the command in force is
/// standstill.
class CommandGate {
 public:
  explicit CommandGate(const CommandGateConfig& config = {});

  /// `received`: when it arrived, on the same clock as `now` below; the sender's stamp plays no
  /// part. A command that is not finite is refused (false) and leaves the watchdog running.
  bool accept(const Twist2& command, Time received);

  [[nodiscard]] EmergencyStops& emergency_stops() { return stops_; }
  [[nodiscard]] const EmergencyStops& emergency_stops() const { return stops_; }

  struct Decision {
    Twist2 command;  ///< standstill unless cause is kCommand
    DriveCause cause = DriveCause::kNoCommand;
  };
  [[nodiscard]] Decision decide(Time now) const;

 private:
  Duration timeout_;
  struct Received {
    Twist2 command;
    Time at;
  };
  std::optional<Received> last_;
  EmergencyStops stops_;
};

}  // namespace coop::vehicle
