#pragma once
#include <memory>

#include "launcher/base.hpp"

namespace coop::runtime {
class Transport;
}

namespace coop::launcher {

/// The base behind `odom` and `emergency_stop`. The launcher is a source of the emergency stop of
/// its own (`launcher`): released when this is made, as a launcher before may have left it engaged,
/// and engaged by halt(). `odom` is listened to from halt() on only.
class DdsBase : public Base {
 public:
  explicit DdsBase(runtime::Transport& transport);
  ~DdsBase() override;
  void halt() override;
  [[nodiscard]] Motion motion() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coop::launcher
