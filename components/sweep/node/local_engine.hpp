#pragma once
#include "sweep/node/engine.hpp"

namespace coop::sweep {

/// Runs side by side on this machine, each in a DDS domain of its own.
class LocalEngine : public Engine {
 public:
  /// One domain for each of the `jobs`: those from `first_domain` on that are free.
  LocalEngine(int jobs, int first_domain) : jobs_(jobs), first_domain_(first_domain) {}

  void make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) override;

 private:
  int jobs_;
  int first_domain_;
};

}  // namespace coop::sweep
