#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sweep/inputs.hpp"
#include "sweep/sweep_config.hpp"

namespace coop::sweep {

/// Where a sweep's results lie and what it is made of.
struct Sweep {
  SweepConfig config;
  std::filesystem::path file;    ///< the sweep file
  std::filesystem::path folder;  ///< of all results
  Places places;
  Inputs inputs;  ///< as they were when it began
};

/// Makes runs: each leaves its result.json, whatever becomes of it. One word to the watcher after
/// each run; where the watcher answers false, what runs is stopped without a result.
class Engine {
 public:
  using Watcher = std::function<bool()>;
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Returns when all are made, or when stopped. `watch` is asked several times a second.
  virtual void make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) = 0;
  /// A few words on what it is doing; may be empty.
  [[nodiscard]] virtual std::string status() const { return {}; }
};

}  // namespace coop::sweep
