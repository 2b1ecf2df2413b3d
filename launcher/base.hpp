#pragma once

namespace coop::launcher {

/// The robot's base, as far as an orderly end of the system needs it.
class Base {
 public:
  enum class Motion {
    kNone,     ///< nobody tells of a base
    kUnknown,  ///< somebody is there and has said nothing yet, or nothing for long
    kMoving,
    kAtRest,
  };
  virtual ~Base() = default;
  /// From now on it takes no command and brakes.
  virtual void halt() = 0;
  /// As it was told last; meaningful after halt().
  [[nodiscard]] virtual Motion motion() = 0;
};

}  // namespace coop::launcher
